#include "base/error.hpp"
#include "kernels/scheme.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("schemes are parsed by name and refuse what they do not know") {
  CHECK(Scheme::parse("radau2").stages() == 2);
  CHECK(Scheme::parse("radau3").stages() == 3);
  CHECK(Scheme::parse("bdf1").theta() == 0);
  CHECK(Scheme::parse("bdf2").theta() == 1);
  CHECK(Scheme::parse("theta:0.75").theta() == 0.75);
  CHECK(Scheme::parse("theta:0.75").name() == "theta:0.75");
  CHECK(Scheme::parse("theta:1").name() == "bdf2");
  for (const char* bad :
       {"", "radau4", "theta:", "theta:1.5", "theta:-0.1", "theta:0.5x", "theta:nan"})
    CHECK_THROWS_AS(Scheme::parse(bad), Error);
}

TEST_CASE("Delta inverts the Butcher matrix and has the root of a second derivative at zeta = 1") {
  for (const Scheme& radau : {Scheme::radau2(), Scheme::radau3()}) {
    const StageMatrixC inverse = radau.delta(0).inverse();
    CHECK((inverse - radau.integration().cast<Complex>()).norm() < 2e-15);
    CHECK(std::abs(radau.delta(1).determinant()) < 2e-13);
    // stage times to the power m are integrals of m t^(m-1), up to the number of stages
    for (int m = 1; m <= radau.stages(); ++m) {
      const StageVector t = radau.stage_times();
      const StageVector rate = m * t.array().pow(m - 1).matrix();
      CHECK((radau.integration() * rate - t.array().pow(m).matrix()).norm() < 1e-14);
    }
  }
  for (double theta : {0.0, 0.4, 1.0}) {
    const Scheme s = Scheme::multistep(theta);
    CHECK(std::abs(s.delta(1)(0, 0)) < 1e-15);
    const Complex zeta(0.3, 0.2);
    CHECK(std::abs(s.delta(zeta)(0, 0) - ((1.0 - zeta) + theta / 2 * (1.0 - zeta) * (1.0 - zeta))) <
          1e-15);
  }
}

TEST_CASE("the initial components rebuild functions of Delta(0)") {
  for (const Scheme& s : {Scheme::radau2(), Scheme::radau3(), Scheme::multistep(0.75)}) {
    // f(Delta) = Delta^{-2}: the spectral form against the matrix itself
    const StageMatrixC exact = (s.delta(0) * s.delta(0)).inverse();
    StageMatrix sum = StageMatrix::Zero(s.stages(), s.stages());
    for (const InitialComponent& c : s.initial_components())
      sum +=
          c.multiplicity() * (c.left * c.right.transpose() / (c.eigenvalue * c.eigenvalue)).real();
    CHECK((sum - exact.real()).norm() < 1e-14);
  }
}

TEST_CASE("the components of Radau IIA rebuild the powers of zeta of any function of Delta") {
  for (const Scheme& s : {Scheme::radau2(), Scheme::radau3()}) {
    // f(Delta) = (2 + Delta)^{-1}: coefficients of zeta from two values on a small circle
    const auto f = [&s](Complex zeta) {
      return StageMatrixC(
          (2.0 * StageMatrixC::Identity(s.stages(), s.stages()) + s.delta(zeta)).inverse());
    };
    constexpr int kPoints = 64;
    for (const int k : {1, 2, 5}) {
      StageMatrixC weight = StageMatrixC::Zero(s.stages(), s.stages());
      for (int l = 0; l < kPoints; ++l)
        weight += f(std::polar(0.7, 2 * kPi * l / kPoints)) *
                  std::polar(std::pow(0.7, -k) / kPoints, -2 * kPi * k * l / kPoints);
      const ComponentVectorC x = s.extract(weight);
      StageMatrixC sum = StageMatrixC::Zero(s.stages(), s.stages());
      for (int m = 0; m < x.size(); ++m)
        sum += x[m] * s.lag_components()[m].left * s.lag_components()[m].right.transpose();
      CHECK((sum - weight).norm() < 1e-12);
      CHECK(weight.norm() > 1e-9);
    }
  }
}

TEST_CASE("the default history follows its rule") {
  CHECK(default_history_length(Scheme::multistep(0), 3.5) == 5 + 2);
  CHECK(default_history_length(Scheme::multistep(0.75), 3.5) == 5 + 6);
  CHECK(default_history_length(Scheme::radau2(), 2.0) == 4 + 2);
  CHECK(default_history_length(Scheme::radau2(), 20.0) == 22 + 9);
  CHECK(default_history_length(Scheme::radau2(), 0.01) == 2 + 1);
}

TEST_CASE("a history chosen by tolerance grows with accuracy and matches the Poisson tail") {
  const Scheme bdf1 = Scheme::multistep(0);
  // documented lengths for a tail of 1e-2, 1e-3, 1e-4 at lam = 2 and 11
  CHECK(history_length_for_tolerance(bdf1, 2, 1e-2) == 6);
  CHECK(history_length_for_tolerance(bdf1, 2, 1e-3) == 8);
  CHECK(history_length_for_tolerance(bdf1, 2, 1e-4) == 9);
  CHECK(history_length_for_tolerance(bdf1, 11, 1e-3) == 23);
  CHECK(history_length_for_tolerance(Scheme::radau2(), 3.5, 1e-6) >
        history_length_for_tolerance(Scheme::radau2(), 3.5, 1e-3));
}
