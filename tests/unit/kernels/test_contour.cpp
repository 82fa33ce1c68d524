#include "kernels/contour.hpp"
#include "support/lag_matrices.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("contour weights of the BDF2 exponential agree with the reference") {
  const auto data = bem_test::load_reference("cq_weights.json");
  const Scheme bdf2 = Scheme::multistep(1);
  for (const auto& entry : data["bdf2_exp"]) {
    const double lam = bem_test::number(entry["lam"]);
    const int last = static_cast<int>(entry["w"].size()) - 1;
    const ContourQuadrature contour(bdf2, last);
    std::vector<double> lanes(contour.layout().count());
    contour.weights(
        1, [lam](Complex d, Complex* v) { *v = std::exp(-d * lam); }, lanes.data());
    for (int k = 0; k <= last; ++k)
      CHECK(std::abs(lanes[k] - bem_test::number(entry["w"][k])) < 1e-13);
  }
}

TEST_CASE("three components carry the full 2x2 Radau weights of a rational function") {
  // (Delta - z)^{-1} has the power series R, R p e^T R, ...; compare with plain matrix recursion:
  // (D0 - z + zeta D1) X(zeta) = 1  =>  X_0 = (D0 - z)^{-1},  X_k = -X_0 D1 X_{k-1}
  const Scheme radau = Scheme::radau2();
  const double pole = -0.4;
  const int last = 12;
  const ContourQuadrature contour(radau, last);
  std::vector<double> lanes(contour.layout().count());
  contour.weights(
      1, [pole](Complex d, Complex* v) { *v = 1.0 / (d - pole); }, lanes.data());
  const StageMatrix d0 = radau.delta_coefficients()[0], d1 = radau.delta_coefficients()[1];
  StageMatrix x = (d0 - pole * StageMatrix::Identity(2, 2)).inverse();
  const StageMatrix x0 = x;
  for (int k = 0; k <= last; ++k) {
    CHECK((bem_test::stage_matrix(radau, contour.layout(), lanes.data(), k) - x).norm() < 1e-13);
    x = (-x0 * d1 * x).eval();
  }
}

TEST_CASE("closed weights sum to the transfer function at zeta = 1") {
  for (const Scheme& s : {Scheme::radau2(), Scheme::multistep(0.5), Scheme::multistep(1)}) {
    const double lam = 6;
    const int last = 9;  // far too short on purpose
    const ContourQuadrature contour(s, last);
    std::vector<double> lanes(contour.layout().count());
    const auto f = [lam](Complex d, Complex* v) { *v = std::exp(-d * lam) + 0.5; };
    contour.weights(1, f, lanes.data(), true);
    StageMatrix sum = StageMatrix::Zero(s.stages(), s.stages());
    for (int k = 0; k <= last; ++k)
      sum += bem_test::stage_matrix(s, contour.layout(), lanes.data(), k);
    // the eigenvector of Delta(1) for the eigenvalue 0 is the constant: f(Delta(1)) 1 = f(0) 1
    const StageVector ones = StageVector::Ones(s.stages());
    CHECK((sum * ones - 1.5 * ones).norm() < 1e-13);
  }
}
