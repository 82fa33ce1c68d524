#include "quadrature/touching_triangles.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr Adjacency kAll[] = {Adjacency::vertex, Adjacency::edge, Adjacency::identical};

Vec3 place(const double* l, const std::array<Vec3, 3>& corners) {
  return l[0] * corners[0] + l[1] * corners[1] + l[2] * corners[2];
}

/// Right triangles of which the first has a short edge of `height`; the others are on edge to it.
TouchingTriangles pair_of_height(Adjacency adjacency, double height) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, height, 0), d(1, 0, 1), e(-1, 0, 0.3), f(0, -height, 0.1);
  const std::array<Vec3, 3> x = {a, b, c};
  return {adjacency, x,
          adjacency == Adjacency::identical ? x
          : adjacency == Adjacency::edge    ? std::array<Vec3, 3>{a, b, d}
                                            : std::array<Vec3, 3>{a, e, f}};
}

std::vector<PairPoint> rule(const TouchingTriangles& pair, const TouchingAccuracy& accuracy) {
  std::vector<PairPoint> some, all;
  touching_rule(pair, accuracy, some, [&] { all.insert(all.end(), some.begin(), some.end()); });
  CHECK(touching_rule_size(pair, accuracy, 1u << 30) == all.size());
  return all;
}

/// int int 1/|x - y| as a part of the product of the areas.
double integral(const TouchingTriangles& pair, double tolerance) {
  double sum = 0;
  for (const PairPoint& p : rule(pair, {3, 2, tolerance}))
    sum += p.weight / (place(p.x, pair.x) - place(p.y, pair.y)).norm();
  return sum;
}

/// int int L_0(x)/|x - y|^3 (x - y), which exists as a principal value.
Vec3 force(const TouchingTriangles& pair, double tolerance) {
  Vec3 sum = Vec3::Zero();
  for (const PairPoint& p : rule(pair, {3, 2, tolerance})) {
    const Vec3 r = place(p.x, pair.x) - place(p.y, pair.y);
    sum += p.weight * p.x[0] / std::pow(r.norm(), 3) * r;
  }
  return sum;
}

/// The same on triangles whose corners stand in another order; those that they share stay so.
TouchingTriangles reordered(const TouchingTriangles& pair) {
  TouchingTriangles other = pair;
  if (pair.adjacency == Adjacency::vertex) {
    std::swap(other.x[1], other.x[2]);
  } else {
    std::swap(other.x[0], other.x[1]);
    std::swap(other.y[0], other.y[1]);
  }
  return other;
}

}  // namespace

TEST_CASE("rules of touching triangles integrate polynomials exactly") {
  // means of L_0^a L_1^b over a triangle are 2 a! b!/(a + b + 2)!
  const auto mean = [](int a, int b) {
    return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3);
  };
  for (const Adjacency adjacency : kAll)
    for (const double height : {1.0, 0.02}) {
      const auto points = rule(pair_of_height(adjacency, height), {5, 5, 1e-8});
      for (int a = 0; a <= 2; ++a)
        for (int b = 0; b <= 1; ++b)
          for (int c = 0; c <= 2; ++c) {
            double sum = 0;
            for (const PairPoint& p : points)
              sum += p.weight * std::pow(p.x[0], a) * std::pow(p.x[1], b) * std::pow(p.y[2], c);
            CHECK(sum == Approx(mean(a, b) * mean(c, 0)).epsilon(1e-13));
          }
    }
}

TEST_CASE("rules of touching triangles keep their tolerance, however slender the triangles are") {
  for (const Adjacency adjacency : kAll)
    for (const double height : {1.0, 0.1, 0.01, 1e-4}) {
      const TouchingTriangles pair = pair_of_height(adjacency, height);
      const double exact = integral(reordered(pair), 1e-13);
      const Vec3 exact_force = force(pair, 1e-13);
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        INFO("adjacency " << static_cast<int>(adjacency) << ", height " << height << ", tolerance "
                          << tolerance);
        CHECK(std::abs(integral(pair, tolerance) / exact - 1) < tolerance);
        CHECK((force(pair, tolerance) - exact_force).norm() <
              3 * tolerance * std::max(exact, exact_force.norm()));
      }
    }
}

TEST_CASE("rules of touching triangles have few points") {
  const auto count = [](Adjacency adjacency, double height) {
    return rule(pair_of_height(adjacency, height), {3, 2, 1e-6}).size();
  };
  CHECK(count(Adjacency::identical, 1) < 600);
  CHECK(count(Adjacency::edge, 1) < 1700);
  CHECK(count(Adjacency::vertex, 1) < 2600);
  // halved only towards where the distance is small: as the logarithm of the slenderness
  for (const Adjacency adjacency : kAll)
    CHECK(count(adjacency, 1e-4) < 10 * count(adjacency, 1e-1));
}

TEST_CASE("rules of many points come in parts, and are counted only so far") {
  const TouchingTriangles pair = pair_of_height(Adjacency::vertex, 1e-5);
  std::vector<PairPoint> points;
  std::size_t parts = 0, all = 0;
  double weights = 0;
  touching_rule(pair, {8, 8, 1e-9}, points, [&] {
    ++parts;
    all += points.size();
    for (const PairPoint& p : points) weights += p.weight;
  });
  CHECK(parts > 1);
  CHECK(weights == Approx(1).epsilon(1e-10));
  CHECK(touching_rule_size(pair, {8, 8, 1e-9}, 1u << 30) == all);
  const std::size_t some = touching_rule_size(pair, {8, 8, 1e-9}, 1000);
  CHECK(some > 1000);
  CHECK(some < all);
}
