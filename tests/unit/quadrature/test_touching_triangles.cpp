#include "base/types.hpp"
#include "quadrature/touching_triangles.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("rules of touching triangles integrate polynomials exactly") {
  // means of L_0^a L_1^b over a triangle are 2 a! b!/(a + b + 2)!
  const auto mean = [](int a, int b) {
    return 2 * std::tgamma(a + 1) * std::tgamma(b + 1) / std::tgamma(a + b + 3);
  };
  for (const Adjacency adjacency : {Adjacency::vertex, Adjacency::edge, Adjacency::identical}) {
    const auto points = touching_rule(adjacency, 5, 5);
    const std::size_t regions = static_cast<std::size_t>(adjacency) == 1   ? 2
                                : static_cast<std::size_t>(adjacency) == 2 ? 5
                                                                           : 6;
    REQUIRE(points.size() == regions * 625);
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

TEST_CASE("rules of touching triangles converge for kernels of 1/r") {
  // int int 1/|x - y| over the two halves of a square, or one of them with itself
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(1, -1, 0);
  const auto place = [](const double* l, const Vec3& u, const Vec3& v, const Vec3& w) {
    return Vec3(l[0] * u + l[1] * v + l[2] * w);
  };
  const auto integral = [&](Adjacency adjacency, int n) {
    double sum = 0;
    for (const PairPoint& p : touching_rule(adjacency, n, 3)) {
      const Vec3 x = place(p.x, a, b, c);
      const Vec3 y = adjacency == Adjacency::identical ? place(p.y, a, b, c)
                     : adjacency == Adjacency::edge    ? place(p.y, a, b, d)
                                                       : place(p.y, a, d, Vec3(0, -1, 0.5));
      sum += p.weight / (x - y).norm();
    }
    return sum;
  };
  for (const Adjacency adjacency : {Adjacency::vertex, Adjacency::edge, Adjacency::identical}) {
    const double exact = integral(adjacency, 16);
    const double coarse = std::abs(integral(adjacency, 4) / exact - 1),
                 fine = std::abs(integral(adjacency, 8) / exact - 1);
    INFO("errors " << coarse << " " << fine);
    CHECK(coarse < 1e-3);
    CHECK(fine < 3e-6);
    CHECK(fine < 0.05 * coarse);
  }
}
