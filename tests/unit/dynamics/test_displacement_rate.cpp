#include "dynamics/displacement_rate.hpp"

#include <cmath>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// The rate after six steps of displacements (t/T)^power, over its exact value.
double found(const Scheme& scheme, int power) {
  const double dt = 0.25;
  DisplacementRate rate(scheme, dt, 1);
  for (int n = 0; n < 6; ++n) {
    Eigen::MatrixXd stages(1, scheme.stages());
    for (int a = 0; a < scheme.stages(); ++a)
      stages(0, a) = std::pow(dt * (n + scheme.stage_times()[a]), power);
    rate.push(stages);
  }
  return rate.value()[0] / (power * std::pow(6 * dt, power - 1));
}

}  // namespace

TEST_CASE("rates of displacements are exact for polynomials up to the order of the stages") {
  for (int power : {1, 2}) CHECK(found(Scheme::radau2(), power) == Approx(1).epsilon(1e-13));
  for (int power : {1, 2, 3}) CHECK(found(Scheme::radau3(), power) == Approx(1).epsilon(1e-13));
  CHECK(found(Scheme::multistep(0), 1) == Approx(1).epsilon(1e-13));
  for (int power : {1, 2}) CHECK(found(Scheme::multistep(1), power) == Approx(1).epsilon(1e-13));
  CHECK(std::abs(found(Scheme::multistep(0), 2) - 1) > 0.05);
  CHECK(std::abs(found(Scheme::radau2(), 3) - 1) > 1e-3);
}

TEST_CASE("without steps nothing moves") {
  const DisplacementRate rate(Scheme::radau2(), 0.1, 4);
  CHECK(rate.value().isZero(0));
}
