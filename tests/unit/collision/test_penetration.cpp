#include "collision/penetration.hpp"
#include "collision_test.hpp"

using namespace bem;
using namespace bem::test;

TEST_CASE("depth below a plane") {
  const CollisionPlane plane{{0, 0, 1}, Vec3(0, 3, 4) / 5};
  const Penetration found =
      deepest_penetration({{0, 0, 2}, {0, 0, 0.5}, {7, -1, 1}, {0, 0, 0.75}}, plane);
  CHECK(found.depth == Approx(0.6));
  CHECK(found.vertex == 2);
  CHECK(deepest_penetration({{0, 0, 2}}, plane).vertex == -1);
}

TEST_CASE("depth inside closed surfaces") {
  const TriangleMesh cube = box({2, 2, 2}, {3, 3, 3});
  const std::vector<Vec3> points = {{3, 0, 0}, {0, 0.9, 0.2}, {0.3, -0.4, 0.75}, {1.01, 1.01, 0.5}};
  const Penetration found = deepest_penetration(points, cube.triangles, cube.vertices);
  CHECK(found.depth == Approx(0.25));
  CHECK(found.vertex == 2);
  CHECK(deepest_penetration({{1.01, 1.01, 0.5}}, cube.triangles, cube.vertices).vertex == -1);
  // The hole of a torus and the hollow of a bowl are outside; near edges of every kind.
  const TriangleMesh ring = torus(1, 0.3, 40, 16);
  CHECK(deepest_penetration({{0, 0, 0}, {0.6, 0, 0}}, ring.triangles, ring.vertices).depth == 0);
  CHECK(deepest_penetration({{0, 1, 0}}, ring.triangles, ring.vertices).depth ==
        Approx(0.3).epsilon(0.03));
  const TriangleMesh dish = bowl(1, 0.1, 40);
  CHECK(deepest_penetration({{0, 0, -0.85}, {0.5, 0, -0.3}}, dish.triangles, dish.vertices).depth ==
        0);
  CHECK(deepest_penetration({{0, 0, -0.95}}, dish.triangles, dish.vertices).depth > 0.04);
}
