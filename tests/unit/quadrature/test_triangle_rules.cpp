#include "quadrature/triangle_rules.hpp"
#include "support/reference.hpp"

#include <cmath>

#include <catch2/catch.hpp>

namespace {

/// int over the unit triangle of a^i b^j c^k / area = 2 i! j! k! / (i+j+k+2)!
double monomial_mean(int i, int j, int k) {
  return 2 * std::tgamma(i + 1.0) * std::tgamma(j + 1.0) * std::tgamma(k + 1.0) /
         std::tgamma(i + j + k + 3.0);
}

double worst_defect(const bem::TriangleRule& rule, int degree) {
  double worst = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) {
      const int k = degree - i - j;
      double sum = 0;
      for (int q = 0; q < rule.size; ++q) {
        const bem::TrianglePoint& p = rule.points[q];
        sum += p.weight * std::pow(p.barycentric[0], i) * std::pow(p.barycentric[1], j) *
               std::pow(p.barycentric[2], k);
      }
      worst = std::max(worst, std::abs(sum - monomial_mean(i, j, k)));
    }
  return worst;
}

}  // namespace

TEST_CASE("triangle rules have exactly the stated degree, positive weights and interior points") {
  const int sizes[] = {1, 3, 6, 7, 12, 16, 25, 33};
  const int degrees[] = {1, 2, 4, 5, 6, 8, 10, 12};
  for (int i = 0; i < bem::kTriangleRuleCount; ++i) {
    const bem::TriangleRule& rule = bem::triangle_rules()[i];
    CHECK(rule.size == sizes[i]);
    CHECK(rule.degree == degrees[i]);
    for (int degree = 0; degree <= rule.degree; ++degree) CHECK(worst_defect(rule, degree) < 1e-15);
    CHECK(worst_defect(rule, rule.degree + 1) > 1e-9);
    for (int q = 0; q < rule.size; ++q) {
      CHECK(rule.points[q].weight > 0);
      for (double b : rule.points[q].barycentric) CHECK((b > 0 && b < 1));
    }
  }
}

TEST_CASE("triangle rules have the points and weights of the reference") {
  const bem_test::json data = bem_test::load_reference("triangle_rules.json");
  for (const bem::TriangleRule& rule : bem::triangle_rules()) {
    const bem_test::json& exact = data["rules"][std::to_string(rule.degree)];
    INFO("degree " << rule.degree);
    REQUIRE(static_cast<int>(exact["points"].size()) == rule.size);
    for (int q = 0; q < rule.size; ++q) {
      double nearest = 1;  // the points may come in another order
      for (int e = 0; e < rule.size; ++e) {
        double difference = std::abs(rule.points[q].weight - bem_test::number(exact["weights"][e]));
        for (int i = 0; i < 3; ++i)
          difference = std::max(difference, std::abs(rule.points[q].barycentric[i] -
                                                     bem_test::number(exact["points"][e][i])));
        nearest = std::min(nearest, difference);
      }
      CHECK(nearest < 1e-16);
    }
  }
}
