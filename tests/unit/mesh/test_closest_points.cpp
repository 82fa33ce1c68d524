#include "mesh/closest_points.hpp"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

Vec3 random_point(std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

/// Least distance over a grid of points of the triangle.
double sampled_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, int n) {
  double least = 1e9;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      least = std::min(least, (a + (b - a) * i / n + (c - a) * j / n - p).norm());
  return least;
}

}  // namespace

TEST_CASE("the closest point of a triangle beats all sampled points") {
  std::mt19937_64 generator(1);
  int features[3] = {0, 0, 0};
  for (int i = 0; i < 300; ++i) {
    const Vec3 a = random_point(generator), b = random_point(generator),
               c = random_point(generator);
    const Vec3 p = 1.5 * random_point(generator);
    const NearestPoint closest = closest_on_triangle(p, a, b, c);
    ++features[static_cast<int>(closest.feature)];
    const Vec3 sum = closest.weights[0] * a + closest.weights[1] * b + closest.weights[2] * c;
    CHECK((sum - closest.point).norm() < 1e-12);
    CHECK(*std::min_element(closest.weights.begin(), closest.weights.end()) >= 0);
    const double distance = (closest.point - p).norm();
    const double sampled = sampled_distance(p, a, b, c, 60);
    CHECK(distance <= sampled + 1e-12);
    CHECK(distance >= sampled - 0.05);
    if (closest.feature == NearestPoint::Feature::face)
      CHECK(std::abs((p - closest.point).dot(b - a)) < 1e-9);
    if (closest.feature == NearestPoint::Feature::edge)
      CHECK(closest.weights[(closest.index + 2) % 3] == 0);
    if (closest.feature == NearestPoint::Feature::corner)
      CHECK(closest.weights[closest.index] == 1);
  }
  for (int n : features) CHECK(n >= 20);
}

TEST_CASE("lines come closest where their connection is normal to both") {
  std::mt19937_64 generator(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = random_point(generator), q = random_point(generator);
    const Vec3 r = random_point(generator), t = random_point(generator);
    const LinePair pair = closest_on_lines(p, q, r, t);
    const Vec3 between = p + pair.s * (q - p) - r - pair.u * (t - r);
    CHECK(std::abs(between.dot(q - p)) < 1e-8);
    CHECK(std::abs(between.dot(t - r)) < 1e-8);
    CHECK(pair.sine == Approx((q - p).normalized().cross((t - r).normalized()).norm()));
  }
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
  CHECK(closest_on_lines(Vec3::Zero(), x, y, y + x).sine == 0);
  CHECK(closest_on_lines(Vec3::Zero(), x, y, y).sine == 0);
}
