#include "dynamics/load_shape.hpp"
#include "files/state_file.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr std::size_t kTriangles = 4;

/// A constant load of two inputs on triangle 3, and the second input's on a corner of triangle 1.
std::vector<PanelLoad> some_panels() {
  Eigen::Matrix3Xd both(3, 2), second = Eigen::Matrix3Xd::Zero(3, 2);
  both << 1, 2, 3, 4, 5, 6;
  second.col(1) = Vec3(7, 0, 8);
  return {{3, both, std::nullopt}, {1, second, 2}};
}

LoadShape restored(const LoadShape& saved) {
  const test::TemporaryFolder folder("load_shape");
  LoadShape shape = saved, out;
  StateWriter writer(folder / "s");
  writer(shape);
  writer.commit();
  StateReader reader(folder / "s");
  reader(out);
  reader.finish();
  return out;
}

}  // namespace

TEST_CASE("a load's shape has its panels, also when it was saved") {
  const LoadShape shape(some_panels(), 2);
  for (const LoadShape& s : {shape, restored(shape)}) {
    REQUIRE(s == shape);
    REQUIRE(s.fits(kTriangles));
    const std::vector<PanelLoad> panels = s.panels();
    REQUIRE(panels.size() == 2);
    for (std::size_t i : {0, 1}) {
      CHECK(panels[i].triangle == some_panels()[i].triangle);
      CHECK(panels[i].corner == some_panels()[i].corner);
      CHECK(panels[i].traction == some_panels()[i].traction);
    }
  }
  REQUIRE(LoadShape().fits(kTriangles));
  REQUIRE(LoadShape().panels().empty());
}

TEST_CASE("loads that differ in anything have different shapes") {
  const LoadShape shape(some_panels(), 2);
  std::vector<PanelLoad> other = some_panels();
  other[0].triangle = 2;
  CHECK_FALSE(shape == LoadShape(other, 2));
  other = some_panels();
  other[1].corner = 1;
  CHECK_FALSE(shape == LoadShape(other, 2));
  other = some_panels();
  other[1].traction(2, 1) = 9;
  CHECK_FALSE(shape == LoadShape(other, 2));
}

TEST_CASE("a load's shape of another mesh does not fit") {
  std::vector<PanelLoad> panels = some_panels();
  CHECK_FALSE(LoadShape(panels, 2).fits(3));
  panels[0].triangle = -1;
  CHECK_FALSE(LoadShape(panels, 2).fits(kTriangles));
  panels = some_panels();
  panels[0].corner = 3;
  CHECK_FALSE(LoadShape(panels, 2).fits(kTriangles));
  CHECK_FALSE(LoadShape({}, 9 * kTriangles + 1).fits(kTriangles));
}
