#include "convergence/trend.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// Runs as the columns of a matrix, and the products of their differences from the first.
struct Runs {
  std::vector<double> sizes;
  Eigen::MatrixXd values;

  Eigen::MatrixXd products() const {
    const Eigen::MatrixXd differences = values.colwise() - values.col(0);
    return differences.transpose() * differences;
  }
};

/// u + c h^order at h = 4, 2, 1, 1/2, ...
Runs power_law(double order, int count, double noise = 0) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto numbers = [&] {
    Eigen::VectorXd v(300);
    for (double& x : v) x = normal(random);
    return v;
  };
  const Eigen::VectorXd limit = 1000 * numbers(), direction = numbers();
  Runs out;
  out.values.resize(limit.size(), count);
  for (int k = 0; k < count; ++k) {
    const double size = std::ldexp(4.0, -k), power = std::pow(size, order);
    out.sizes.push_back(size);
    out.values.col(k) = limit + power * direction + noise * power * numbers();
  }
  return out;
}

double error_of(const Trend& trend, const Runs& runs, int run) {
  return norm_of(trend.limit - Eigen::VectorXd::Unit(runs.values.cols(), run), runs.products());
}

}  // namespace

TEST_CASE("A power law gives its order and its limit", "[trend]") {
  for (double order : {1.0, 1.5, 2.0}) {
    const Runs runs = power_law(order, 4);
    const Trend trend = find_trend(runs.sizes, runs.products(), 2);
    CHECK(trend.converges);
    REQUIRE(trend.order);
    CHECK(std::abs(*trend.order - order) < 0.006);
    CHECK(std::abs(trend.limit.sum() - 1) < 1e-12);
    const double expected = (runs.values.col(0) - runs.values.col(1)).norm() /
                            (std::pow(4, order) - std::pow(2, order));
    CHECK(error_of(trend, runs, 2) == Approx(expected).epsilon(0.02));
    CHECK(error_of(trend, runs, 3) == Approx(expected * std::pow(0.5, order)).epsilon(0.05));
  }
}

TEST_CASE("A limit is as far away as the expected order says, if a higher one is observed",
          "[trend]") {
  const Runs runs = power_law(3, 3);
  const Trend trend = find_trend(runs.sizes, runs.products(), 2);
  REQUIRE(trend.order);
  CHECK(*trend.order == Approx(3).margin(0.01));
  const double exact = (runs.values.col(1) - runs.values.col(2)).norm() / 7;
  CHECK(error_of(trend, runs, 2) > 1.5 * exact);
  CHECK(error_of(find_trend(runs.sizes, runs.products(), 4), runs, 2) ==
        Approx(exact).epsilon(0.02));
}

TEST_CASE("Two runs have a limit of the expected order, and no observed one", "[trend]") {
  const Runs runs = power_law(2, 2);
  const Trend trend = find_trend(runs.sizes, runs.products(), 2);
  CHECK(trend.converges);
  CHECK(!trend.order);
  const double expected = (runs.values.col(0) - runs.values.col(1)).norm() / 3;
  CHECK(error_of(trend, runs, 1) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("Errors without a common direction have an order by their sizes", "[trend]") {
  const Runs runs = power_law(2, 5, 3);
  const Trend trend = find_trend(runs.sizes, runs.products(), 2);
  CHECK(trend.converges);
  REQUIRE(trend.order);
  CHECK(*trend.order == Approx(2).margin(0.2));
  CHECK(!find_trend({4, 2, 1}, runs.products().topLeftCorner(3, 3), 2).order);
}

TEST_CASE("A run that is off hides the order, but not that runs converge", "[trend]") {
  Runs runs = power_law(2, 4, 3);
  runs.values.col(0) = runs.values.col(2);
  const Trend trend = find_trend(runs.sizes, runs.products(), 2);
  CHECK(trend.converges);
  CHECK(!trend.order);
  const double last = (runs.values.col(2) - runs.values.col(3)).norm();
  CHECK(error_of(trend, runs, 3) < 0.7 * last);
  CHECK(error_of(trend, runs, 3) > 0.05 * last);
}

TEST_CASE("Runs that have nothing in common do not converge", "[trend]") {
  const Runs noise = power_law(0, 4, 100);
  const Trend trend = find_trend(noise.sizes, noise.products(), 2);
  CHECK(!trend.converges);
  CHECK(!trend.order);
  CHECK(trend.limit == Eigen::VectorXd::Unit(4, 3));

  Runs growing = power_law(1, 3);
  growing.values = growing.values.rowwise().reverse().eval();
  CHECK(!find_trend(growing.sizes, growing.products(), 2).converges);
}
