#include "mesh/shapes.hpp"
#include "mesh/solids.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using test::combined;

namespace {

const TriangleMesh kSolid = box({1, 1, 1}, {2, 2, 2});

}  // namespace

TEST_CASE("a cavity belongs to the solid around it, a solid in a cavity is another one") {
  TriangleMesh mesh = combined({}, kSolid, 0.5, Vec3::Zero(), true);  // cavity of the second
  mesh = combined(mesh, kSolid, 1.0, Vec3::Zero(), false);
  mesh = combined(mesh, kSolid, 1.0, {3, 0, 0}, false);
  mesh = combined(mesh, kSolid, 0.25, Vec3::Zero(), false);  // in the cavity
  const Surface surface = make_surface(mesh, "a.obj");
  const auto solids = find_solids(surface);
  REQUIRE(solids.size() == 3);
  CHECK(solids[0].size() == 96);
  CHECK(solids[0].back() == 95);
  CHECK(solids[1].front() == 96);
  CHECK(solids[2].front() == 144);
  const TriangleMesh part = part_of(surface, solids[1]);
  CHECK(part.triangles == kSolid.triangles);
  REQUIRE(part.vertices.size() == kSolid.vertices.size());
  for (std::size_t v = 0; v < part.vertices.size(); ++v)
    CHECK(part.vertices[v] == kSolid.vertices[v] + Vec3(3, 0, 0));
  CHECK_THAT(
      test::error_message(ErrorCode::invalid_input, [&] { check_single_solid(surface, "a.obj"); }),
      StartsWith("a.obj: 3 separate solids") && Contains("triangle 96 ") &&
          Contains("bemshape split a.obj -o 'part-%d.obj'"));
}

TEST_CASE("one solid may have cavities") {
  TriangleMesh mesh = combined(kSolid, kSolid, 0.25, {0.2, 0, 0}, true);
  mesh = combined(mesh, kSolid, 0.25, {-0.2, 0, 0}, false);
  const Surface surface = make_surface(mesh, "a.obj");
  CHECK_NOTHROW(check_single_solid(surface, "a.obj"));
  CHECK(surface.warnings.size() == 1);  // the second cavity faced outward
  CHECK_THAT(surface.warnings[0], Contains("is its cavity, although its triangles face outward") &&
                                      Contains("1 part of 3, first the one with triangle 96 "));
}
