#include "mesh/free_travel.hpp"
#include "mesh/shapes.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

TriangleMesh moved(TriangleMesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

/// Corners of a box with half lengths.
TriangleMesh box(const Vec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.emplace_back((i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1],
                               (i & 4 ? 1 : -1) * half[2]);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

double travel(const TriangleMesh& moving, const TriangleMesh& still, const Vec3& direction) {
  const auto found = free_travel(moving, still, direction.normalized());
  return found ? *found : 1e9;
}

}  // namespace

TEST_CASE("faces, vertices and edges stop what moves") {
  const TriangleMesh floor = box({10, 1, 10}), cube = box({1, 1, 1});
  CHECK(travel(moved(cube, {0, 5, 0}), floor, {0, -1, 0}) == Approx(3));
  CHECK(travel(moved(cube, {0, -5, 0}), floor, {0, -1, 0}) == Approx(-7));  // it has to go back
  CHECK(travel(moved(cube, {-20, 0, 0}), floor, {1, 0, 0}) == Approx(9));
  CHECK(travel(moved(box({20, 1, 20}), {0, 5, 0}), floor, {0, -1, 0}) == Approx(3));
  // Two rods that cross touch with their edges alone.
  CHECK(travel(moved(box({5, 0.1, 0.1}), {0, 5, 0}), box({0.1, 0.1, 5}), {0, -1, 0}) ==
        Approx(4.8));
  // A slanted path.
  CHECK(travel(moved(cube, {4, 5, 0}), floor, {-1, -1, 0}) == Approx(3 * std::sqrt(2.0)));
}

TEST_CASE("balls meet where their centres are two radii apart") {
  const TriangleMesh ball = icosphere(4, 1);
  const Vec3 direction = Vec3(1, 2, 3).normalized();
  for (double aside : {0.0, 0.5, 1.2}) {
    const Vec3 at = -5 * direction + aside * direction.unitOrthogonal();
    CHECK(travel(moved(ball, at), ball, direction) ==
          Approx(5 - std::sqrt(4 - aside * aside)).margin(0.02));
  }
  CHECK(!free_travel(moved(ball, {2.1, 5, 0}), ball, {0, -1, 0}));
}

TEST_CASE("nothing stops at nothing") {
  CHECK(!free_travel({}, box({1, 1, 1}), {0, -1, 0}));
  CHECK(!free_travel(box({1, 1, 1}), {}, {0, -1, 0}));
}
