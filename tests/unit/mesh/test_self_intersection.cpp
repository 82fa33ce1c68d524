#include "mesh/self_intersection.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;

namespace {

const std::array<Vec3, 3> kFlat = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};

bool crosses_flat(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Vec3, 3> other = {a, b, c};
  CHECK(triangles_cross(kFlat, other) == triangles_cross(other, kFlat));
  return triangles_cross(kFlat, other);
}

SelfIntersections brute_force(const TriangleMesh& mesh) {
  SelfIntersections found;
  const int n = static_cast<int>(mesh.triangles.size());
  for (int s = 0; s < n; ++s) {
    for (int t = s + 1; t < n; ++t) {
      const Triangle& u = mesh.triangles[s];
      const Triangle& v = mesh.triangles[t];
      bool adjacent = false;
      for (int i : u)
        for (int j : v) adjacent = adjacent || i == j;
      if (adjacent || !triangles_cross(triangle_corners(mesh, u), triangle_corners(mesh, v)))
        continue;
      if (found.count++ == 0) {
        found.first = s;
        found.second = t;
      }
    }
  }
  return found;
}

}  // namespace

TEST_CASE("two triangles cross or do not") {
  CHECK(crosses_flat({0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.3, 0.6, 1}));
  CHECK(crosses_flat({0.2, 0.2, -1}, {0.2, 0.2, 1}, {5, 5, 0.5}));       // out over the edge
  CHECK(crosses_flat({-1, 0.2, -1}, {-1, 0.2, 1}, {3, 0.2, 0}));         // right through
  CHECK_FALSE(crosses_flat({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, {1, 1, 1}));  // above
  CHECK_FALSE(crosses_flat({0.9, 0.9, -1}, {0.9, 0.9, 1}, {2, 2, 1}));   // beside
  CHECK_FALSE(crosses_flat({-2, 0.2, -1}, {-2, 0.2, 1}, {-0.1, 0.2, 0}));
}

TEST_CASE("triangles that touch do not cross") {
  CHECK_FALSE(crosses_flat({0.2, 0.2, 0}, {0.2, 0.2, 1}, {1, 1, 1}));      // corner on the face
  CHECK_FALSE(crosses_flat({0.1, 0.1, 0}, {0.4, 0.1, 0}, {0.2, 0.2, 1}));  // edge on the face
  CHECK_FALSE(crosses_flat({0, 0, 0}, {1, 0, 0}, {0.5, 0, 1}));            // a common edge
  CHECK_FALSE(crosses_flat({0.5, 0, -1}, {0.5, 0, 1}, {0.5, -1, 0}));      // edge through edge
  CHECK_FALSE(crosses_flat({0.1, 0.1, 0}, {0.5, 0.1, 0}, {0.1, 0.5, 0}));  // in one plane
}

TEST_CASE("closed bodies do not intersect themselves") {
  for (const TriangleMesh& mesh :
       {icosphere(3, 0.7), star(3, 1.0), box({3, 0.2, 0.1}, {20, 3, 2}), torus(1, 0.3, 40, 12),
        cylinder(0.5, 2, 30, 10), bowl(1, 0.1, 40), notched_cube(1, 6)})
    CHECK(find_self_intersections(mesh).count == 0);
  CHECK(find_self_intersections({}).count == 0);
}

TEST_CASE("overlapping boxes with edges through face diagonals are found") {
  const TriangleMesh cube = box({1, 1, 1}, {1, 1, 1});
  const TriangleMesh mesh = test::combined(cube, cube, 1.0, Vec3::Constant(0.5), false);
  const SelfIntersections found = find_self_intersections(mesh);
  const SelfIntersections expected = brute_force(mesh);
  CHECK(found.count > 0);
  CHECK(found.count == expected.count);
  CHECK(found.first == expected.first);
  CHECK(found.second == expected.second);
}

TEST_CASE("the tree finds the pairs of all against all") {
  TriangleMesh mesh = star(3, 1.0);
  for (std::size_t v = 0; v < mesh.vertices.size(); v += 37) mesh.vertices[v] *= -0.7;
  mesh = test::combined(mesh, torus(1, 0.3, 30, 12), 0.9, {0.3, 0.1, 0}, false);
  const SelfIntersections found = find_self_intersections(mesh);
  const SelfIntersections expected = brute_force(mesh);
  CHECK(expected.count > 100);
  CHECK(found.count == expected.count);
  CHECK(found.first == expected.first);
  CHECK(found.second == expected.second);
}
