#include "mesh/corners.hpp"
#include "mesh/shapes.hpp"

#include <set>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// How many of a point's coordinates are at the surface of the cube: 1 face, 2 edge, 3 corner.
int extremes(const Vec3& x) {
  int count = 0;
  for (int i = 0; i < 3; ++i) count += std::abs(std::abs(x[i]) - 0.5) < 1e-12;
  return count;
}

}  // namespace

TEST_CASE("sharp edges part the triangles around a vertex") {
  const TriangleMesh cube = box(Vec3(1, 1, 1), {3, 3, 3});
  const CornerSectors corners(cube, 40);
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    const auto& sectors = corners.sectors(static_cast<int>(v));
    CHECK(static_cast<int>(sectors.size()) == extremes(cube.vertices[v]));
    std::set<int> all;
    for (const std::vector<int>& sector : sectors) {
      const Vec3 normal = triangle_normal(cube, cube.triangles[sector[0]]);
      for (int t : sector) {
        CHECK((triangle_normal(cube, cube.triangles[t]) - normal).norm() < 1e-12);
        const Triangle& triangle = cube.triangles[t];
        CHECK(std::count(triangle.begin(), triangle.end(), static_cast<int>(v)) == 1);
        CHECK(all.insert(t).second);
      }
    }
    std::size_t around = 0;
    for (const Triangle& t : cube.triangles)
      around += std::count(t.begin(), t.end(), static_cast<int>(v));
    CHECK(all.size() == around);
  }
}

TEST_CASE("edges that are not sharp enough part nothing") {
  const TriangleMesh cube = box(Vec3(1, 1, 1), {2, 2, 2}), ball = icosphere(1, 1);
  const CornerSectors blunt(cube, 91), smooth(ball, 40);
  for (std::size_t v = 0; v < cube.vertices.size(); ++v)
    CHECK(blunt.sectors(static_cast<int>(v)).size() == 1);
  for (std::size_t v = 0; v < ball.vertices.size(); ++v)
    CHECK(smooth.sectors(static_cast<int>(v)).size() == 1);
}
