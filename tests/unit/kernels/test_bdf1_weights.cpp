#include "kernels/bdf1_weights.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem_test;

TEST_CASE("Poisson weights and their tails agree with the high-precision reference") {
  const json data = load_reference("cq_weights.json");
  double worst = 0;
  for (const json& entry : data["scalar"]) {
    const std::vector<int> lags = entry["k"].get<std::vector<int>>();
    const auto w = bem::poisson_weights(number(entry["lam"]), lags.back());
    for (std::size_t i = 0; i < lags.size(); ++i) {
      const auto relative = [&](double value, const json& exact) {
        worst = std::max(worst, std::abs(value - number(exact)) / std::abs(number(exact)));
      };
      relative(w.p[lags[i]], entry["p"][i]);
      relative(w.h[lags[i]], entry["h"][i]);
      relative(w.m0[lags[i]], entry["m0"][i]);
    }
  }
  CHECK(worst < 2e-15);  // relative, even for weights of 1e-77
}

TEST_CASE("BDF1 weights of the radial functions agree with the high-precision reference") {
  const json data = load_reference("cq_weights.json");
  double worst = 0;
  int rows = 0;
  for (const json& entry : data["coef"]) {
    const double nu = number(entry["nu"]), lam = number(entry["lam"]);
    const double kappa = (1 - 2 * nu) / (2 * (1 - nu));
    const auto rest = bem::static_radial_values(kappa);
    int last = 0;
    for (const json& row : entry["rows"]) last = std::max(last, row["k"].get<int>());
    const auto weights = bem::bdf1_radial_weights(lam, kappa, last);
    for (const json& row : entry["rows"]) {
      const int k = row["k"].get<int>();
      bem::RadialValues<double> w = weights[k];
      if (k == 0)  // the reference lists the dynamic parts dP, dQ, dS
        for (int f : {bem::kRadialP, bem::kRadialQ, bem::kRadialS}) w[f] -= rest[f];
      const std::pair<const char*, int> columns[] = {
          {"a", bem::kRadialA},  {"b", bem::kRadialB}, {"dP", bem::kRadialP}, {"dQ", bem::kRadialQ},
          {"dS", bem::kRadialS}, {"F", bem::kRadialF}, {"h2", bem::kRadialM1}};
      for (const auto& [name, f] : columns)
        if (row.contains(name)) {
          worst = std::max(worst, std::abs(w[f] - number(row[name])));
          ++rows;
        }
    }
  }
  CHECK(rows >= 40);
  CHECK(worst < 2e-15);
}

TEST_CASE("weights of a long history sum to the static value") {
  for (double lam : {0.01, 3.0, 60.0}) {
    const auto weights =
        bem::bdf1_radial_weights(lam, 0.25, static_cast<int>(lam + 12 * std::sqrt(lam) + 20));
    const auto rest = bem::static_radial_values(0.25);
    for (int f = 0; f < bem::kRadialCount; ++f) {
      double sum = 0;
      for (const auto& w : weights) sum += w[f];
      CHECK(sum == Approx(rest[f]).margin(1e-12));
    }
  }
}
