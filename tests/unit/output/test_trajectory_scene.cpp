#include "base/error.hpp"
#include "output/trajectory_scene.hpp"
#include "support/temporary_folder.hpp"

#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using Catch::Matchers::Contains;

namespace {

struct SceneContents {
  std::vector<std::int32_t> counts{0, 2, 1};
  std::vector<double> normal{0, 2, 0};
  std::vector<std::int32_t> faces{0, 1, 2};
  std::size_t rows = 3;
};

/// Two frames with obstacles, of which the second in the order of names is the first of the scene.
template <class Read>
auto read_after(const std::function<void(SceneContents&)>& change, const Read& read) {
  const test::TemporaryFolder folder("trajectory_scene");
  SceneContents c;
  change(c);
  Hdf5File out = Hdf5File::create(folder / "t.h5", {"", ErrorCode::resources, 0, true});
  out.write("/time", std::vector<double>{0, 1, 2}, {3});
  out.create_group("/bodies");
  out.write("/obstacles/a/vertices", std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}, {3, 3});
  out.write("/obstacles/a/faces", c.faces, {1, 3});
  out.write("/obstacles/a/translation", std::vector<double>(9, 0.25), {3, 3});
  out.write("/obstacles/a/rotation", std::vector<double>(27, 0.5), {3, 3, 3});
  out.write("/obstacles/z/point", std::vector<double>{1, 2, 3}, {3});
  out.write("/obstacles/z/normal", c.normal, {3});
  out.set_attribute("/obstacles/a", "index", 2);
  out.set_attribute("/obstacles/z", "index", 1);
  out.write("/contacts/counts", c.counts, {3});
  out.write("/contacts/points", std::vector<double>(3 * c.rows, 0.5), {c.rows, 3});
  out.write("/contacts/forces", std::vector<double>(3 * c.rows, 7), {c.rows, 3});
  out.close();
  return read(TrajectoryFile(folder / "t.h5", ErrorCode::archive));
}

void as_it_is(SceneContents&) {}

}  // namespace

TEST_CASE("obstacles of a trajectory are read in the order of the scene") {
  const std::vector<RecordedObstacle> obstacles = read_after(as_it_is, read_obstacles);
  REQUIRE(obstacles.size() == 2);
  CHECK(obstacles[0].name == "z");
  CHECK(obstacles[0].is_plane);
  CHECK(obstacles[0].point == Vec3(1, 2, 3));
  CHECK(obstacles[0].normal == Vec3(0, 1, 0));
  CHECK(obstacles[1].vertices.size() == 9);
  CHECK(obstacles[1].triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(obstacles[1].translations.size() == 9);
  CHECK(obstacles[1].rotations.size() == 27);
}

TEST_CASE("contacts of a trajectory are read") {
  const RecordedContacts contacts = read_after(as_it_is, read_contacts);
  CHECK(contacts.ends == std::vector<std::size_t>{0, 2, 3});
  CHECK(contacts.points.size() == 9);
  CHECK(contacts.forces[8] == 7);
}

TEST_CASE("obstacles and contacts that cannot be are refused") {
  const auto obstacles = [](const auto& change) { read_after(change, read_obstacles); };
  const auto contacts = [](const auto& change) { read_after(change, read_contacts); };
  CHECK_THROWS_WITH(obstacles([](SceneContents& c) { c.faces[1] = 3; }), Contains("out of range"));
  CHECK_THROWS_WITH(contacts([](SceneContents& c) { c.counts[1] = 3; }),
                    Contains("/contacts/points"));
  CHECK_THROWS_WITH(contacts([](SceneContents& c) { c.counts[0] = -1; }), Contains("negative"));
  CHECK_THROWS_WITH(contacts([](SceneContents& c) { c.rows = 2; }), Contains("fewer"));
}

TEST_CASE("up is against gravity") {
  CHECK(up_of_scene(R"({"gravity": [0, 0, -9.81]})") == Vec3(Vec3::UnitZ()));
  CHECK(up_of_scene(R"({"gravity": [0, 0, 0]})") == Vec3(Vec3::UnitY()));
  CHECK(up_of_scene(R"({"gravity": [0, 0, "-981 cm/s^2"]})") == Vec3(Vec3::UnitZ()));
  CHECK(up_of_scene(R"({"gravity": ["x", 0, []]})") == Vec3(Vec3::UnitY()));
  CHECK(up_of_scene("") == Vec3(Vec3::UnitY()));
  CHECK(up_of_scene("no JSON") == Vec3(Vec3::UnitY()));
}
