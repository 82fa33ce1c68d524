#include "mesh/extent.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

#include <random>

using namespace bem;

namespace {

double brute_force(const std::vector<Vec3>& points) {
  double best = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      best = std::max(best, (points[i] - points[j]).squaredNorm());
  return std::sqrt(best);
}

std::vector<Vec3> random_points(int n, unsigned seed) {
  std::mt19937 engine(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const auto next = [&] { return engine() * 0x1p-31 - 1.0; };
    points.emplace_back(next(), next(), next());
  }
  return points;
}

}  // namespace

TEST_CASE("the diameter of small and random sets is that of all pairs") {
  CHECK(diameter({}) == 0);
  CHECK(diameter({{1, 2, 3}}) == 0);
  CHECK(diameter({{1, 2, 3}, {1, 2, 3}}) == 0);
  CHECK(diameter({{1, 2, 3}, {4, 6, 3}}) == 5);
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::vector<Vec3> points = random_points(3 + static_cast<int>(seed * seed), seed);
    CHECK(diameter(points) == brute_force(points));
    for (Vec3& p : points) p = p.normalized() + Vec3(100, 0, 0);  // a sphere off the origin
    CHECK(diameter(points) == brute_force(points));
    for (Vec3& p : points) p = Vec3(p[0] - 100, p[1], 0);  // flat
    CHECK(diameter(points) == brute_force(points));
    for (Vec3& p : points) p[1] = 0;  // a line
    CHECK(diameter(points) == brute_force(points));
  }
}

TEST_CASE("the diameter of bodies is that of all pairs") {
  for (const TriangleMesh& mesh :
       {icosphere(3, 0.7), star(3, 1.0), box({3, 0.2, 0.1}, {20, 3, 2}), torus(1, 0.3, 40, 12),
        cylinder(0.5, 2, 30, 10), bowl(1, 0.1, 40), bumpy_cube(1, 10, 0.2)})
    CHECK(diameter(mesh.vertices) == brute_force(mesh.vertices));
}

TEST_CASE("large spheres take far less than all pairs") {
  // All pairs of 10^5 points would take minutes; the test's time limit is two.
  std::vector<Vec3> points = random_points(100000, 1);
  for (Vec3& p : points) p.normalize();
  const double result = diameter(points);
  CHECK(result <= 2.0 + 1e-15);
  CHECK(result > 1.999999);
}
