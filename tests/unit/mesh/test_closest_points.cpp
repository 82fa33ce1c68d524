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

TEST_CASE("distance of a point from a triangle") {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  CHECK(point_triangle_distance(Vec3(0.5, 0.5, 3), a, b, c) == Approx(3));
  CHECK(point_triangle_distance(Vec3(-3, 0, 4), a, b, c) == Approx(5));
  CHECK(point_triangle_distance(Vec3(2, 2, 0), a, b, c) == Approx(std::sqrt(2.0)));
  CHECK(point_triangle_distance(Vec3(1, -2, 0), a, b, c) == Approx(2));
}

TEST_CASE("distance of segments: between inner points, from an end, and of parallel ones") {
  const Vec3 a(-1, 0, 0), b(1, 0, 0);
  CHECK(segment_distance(a, b, {0.3, -2, 0.5}, {0.3, 1, 0.5}) == Approx(0.5));
  CHECK(segment_distance(a, b, {0.3, 1, 0}, {0.3, 4, 7}) == Approx(1));  // one end
  CHECK(segment_distance(a, b, {4, 4, 0}, {4, 9, 3}) == Approx(5));      // two ends
  CHECK(segment_distance(a, b, {0.5, 2, 0}, {7, 2, 0}) == Approx(2));    // side by side
  CHECK(segment_distance(a, b, {4, 0, 4}, {9, 0, 4}) == Approx(5));      // one behind the other
  CHECK(segment_distance(a, b, {9, 0, 4}, {4, 0, 4}) == Approx(5));
  CHECK(segment_distance(a, b, {0, -1, 0}, {0, 1, 0}) < 1e-15);
}

TEST_CASE("distances of segments and triangles beat all sampled points") {
  std::mt19937_64 generator(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 apart(2.1, 0, 0);
    const std::array<Vec3, 3> x = {random_point(generator), random_point(generator),
                                   random_point(generator)};
    const std::array<Vec3, 3> y = {random_point(generator) + apart, random_point(generator) + apart,
                                   random_point(generator) + apart};
    constexpr int kSamples = 40;
    double sampled = 1e9, from_edge = 1e9;
    for (int k = 0; k <= kSamples; ++k) {
      const double s = static_cast<double>(k) / kSamples;
      for (int l = 0; l <= kSamples; ++l) {
        const double u = static_cast<double>(l) / kSamples;
        from_edge =
            std::min(from_edge, (x[0] + s * (x[1] - x[0]) - y[0] - u * (y[1] - y[0])).norm());
        if (k + l <= kSamples)
          sampled = std::min(
              sampled, point_triangle_distance(x[0] + s * (x[1] - x[0]) + u * (x[2] - x[0]), y[0],
                                               y[1], y[2]));
      }
    }
    const double edges = segment_distance(x[0], x[1], y[0], y[1]);
    CHECK(edges <= from_edge + 1e-12);
    CHECK(edges >= from_edge - 0.08);
    CHECK(edges == Approx(segment_distance(y[1], y[0], x[0], x[1])).margin(1e-12));
    const double triangles = triangle_distance(x, y);
    CHECK(triangles <= edges + 1e-12);
    CHECK(triangles == Approx(triangle_distance(y, x)).margin(1e-12));
    CHECK(triangles <= sampled + 1e-12);
  }
}
