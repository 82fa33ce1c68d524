#include "mesh/components.hpp"
#include "mesh/obstacle_surface.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using test::combined;

namespace {

const TriangleMesh kObstacle = box({1, 1, 1}, {2, 2, 2});

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Component& c : surface_components(mesh)) sum += c.volume;
  return sum;
}

ObstacleSurface surface(const TriangleMesh& mesh) {
  return make_obstacle_surface(mesh, "o.obj");
}

}  // namespace

TEST_CASE("a closed obstacle is solid, whichever way it faces") {
  const ObstacleSurface outward = surface(kObstacle);
  CHECK(outward.warnings.empty());
  CHECK(outward.sheet_triangles() == 0);
  CHECK(volume(outward.solid) == Approx(1));

  const ObstacleSurface inward = surface(combined({}, kObstacle, 1.0, Vec3::Zero(), true));
  CHECK(volume(inward.solid) == Approx(1));
  REQUIRE(inward.warnings.size() == 1);
  CHECK_THAT(inward.warnings[0], Contains("o.obj") && Contains("turned outward") &&
                                     Contains("1 closed part of 1") && Contains("triangle 0"));

  TriangleMesh mixed = kObstacle;
  std::swap(mixed.triangles[5][1], mixed.triangles[5][2]);
  const ObstacleSurface mended = surface(mixed);
  CHECK(volume(mended.solid) == Approx(1));
  REQUIRE(mended.warnings.size() == 1);
  CHECK_THAT(mended.warnings[0], Contains("1 triangle") && Contains("neighbours"));
}

TEST_CASE("a closed part within another is a cavity of the obstacle") {
  const TriangleMesh room = combined(kObstacle, kObstacle, 0.5, Vec3::Zero(), false);
  CHECK(volume(surface(room).solid) == Approx(1 - 0.125));
}

TEST_CASE("what does not enclose anything holds on both sides") {
  TriangleMesh open = kObstacle;
  open.triangles.pop_back();
  CHECK(surface(open).sheet_triangles() == open.triangles.size());
  CHECK(surface(open).solid.triangles.empty());
  CHECK(surface(open).warnings.empty());

  // two cubes that share an edge: four triangles at it
  const TriangleMesh touching = combined(kObstacle, kObstacle, 1.0, {1, 1, 0}, false);
  CHECK(surface(touching).sheet_triangles() == touching.triangles.size());

  // a sheet given from both sides is closed but has no volume, and is one sheet
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  CHECK(surface(flat).sheet_triangles() == 1);

  const TriangleMesh both = combined(kObstacle, open, 1.0, {3, 0, 0}, false);
  CHECK(surface(both).sheet_triangles() == open.triangles.size());
  CHECK(volume(surface(both).solid) == Approx(1));
}

TEST_CASE("triangles without area do not make an obstacle invalid") {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}},
                    {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}}};
  const ObstacleSurface found = surface(mesh);
  CHECK(found.sheet_triangles() == 1);
  REQUIRE(found.warnings.size() == 1);
  CHECK_THAT(found.warnings[0], Contains("2 triangles without area"));
  mesh.triangles.erase(mesh.triangles.begin());
  CHECK_THROWS_WITH(surface(mesh), Contains("o.obj") && Contains("none of the 2 triangles"));
}
