#include "quadrature/gauss.hpp"

#include <cmath>

#include <catch2/catch.hpp>

TEST_CASE("Gauss rules integrate polynomials of degree 2n-1 on [0, 1] and no further") {
  for (int n : {1, 2, 5, 12, 40}) {
    const bem::GaussRule rule = bem::gauss_rule(n);
    const auto defect = [&](int degree) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += rule.weights[i] * std::pow(rule.nodes[i], degree);
      return std::abs(sum - 1.0 / (degree + 1));
    };
    for (int degree = 0; degree < 2 * n; ++degree) CHECK(defect(degree) < 1e-15);
    if (n <= 5) CHECK(defect(2 * n) > 1e-8);
  }
}
