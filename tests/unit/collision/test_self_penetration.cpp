#include "collision/self_penetration.hpp"
#include "collision_test.hpp"

using namespace bem;
using namespace bem::test;

namespace {

/// A clip whose upper arm is moved down by `way` beyond the bend.
TriangleMesh pressed_clip(double way) {
  TriangleMesh mesh = clip({10, 5, 2}, 2, 0.1);
  for (Vec3& v : mesh.vertices)
    if (v[1] > 0 && v[0] > 0) v[1] -= way;
  return mesh;
}

}  // namespace

TEST_CASE("how deep a clip's arm is in the other") {
  for (double depth : {0.01, 0.07}) {
    const TriangleMesh mesh = pressed_clip(0.1 + depth);
    const Penetration found = deepest_self_penetration(mesh.triangles, mesh.vertices, 0.15);
    CHECK(found.depth == Approx(depth));
    CHECK(found.vertex >= 0);
  }
}

TEST_CASE("arms that do not reach each other, and thin walls, do not penetrate") {
  for (double way : {0.0, 0.09}) {
    const TriangleMesh mesh = pressed_clip(way);
    CHECK(deepest_self_penetration(mesh.triangles, mesh.vertices, 0.15).vertex == -1);
  }
  const TriangleMesh ring = torus(1, 0.1, 40, 8);
  CHECK(deepest_self_penetration(ring.triangles, ring.vertices, 0.5).depth == 0);
}
