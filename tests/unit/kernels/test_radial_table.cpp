#include "kernels/bdf1_weights.hpp"
#include "kernels/hypersingular_functions.hpp"
#include "kernels/radial_table.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

double worst_difference(const RadialTable& table, const Scheme& scheme, double lam_max,
                        const Damping& damping = {}) {
  const RadialWeights direct(scheme, table.kappa(), table.layout().last_lag, damping);
  const int lanes = table.layout().count();
  std::vector<double> exact(kRadialCount * lanes), value(kRadialCount * table.lanes().padded_lanes);
  double worst = 0;
  for (int i = 0; i <= 777; ++i) {
    const double lam = lam_max * i / 777;
    direct.evaluate(lam, exact.data());
    table.lanes().evaluate(lam, value.data());
    for (int f = 0; f < kRadialCount; ++f)
      for (int lane = 0; lane < lanes; ++lane)
        worst = std::max(worst, std::abs(value[f * table.lanes().padded_lanes + lane] -
                                         exact[f * lanes + lane]));
  }
  return worst;
}

}  // namespace

TEST_CASE("tables interpolate every scheme to 1e-10 of the static kernel") {
  for (const char* name : {"bdf1", "bdf2", "theta:0.75", "radau2", "radau3"})
    for (double nu : {0.0, 0.3, 0.5})
      for (double lam : {0.3, 3.5, 14.5}) {
        const Scheme scheme = Scheme::parse(name);
        const double kappa = (1 - 2 * nu) / (2 * (1 - nu));
        const RadialTable table(scheme, kappa, lam, default_history_length(scheme, lam));
        INFO(name << ", nu " << nu << ", lam " << lam << ", intervals " << table.lanes().intervals);
        CHECK(worst_difference(table, scheme, lam) < 2e-10);
      }
}

TEST_CASE("tables come to an end at rounding") {
  const Scheme scheme = Scheme::parse("radau2");
  const RadialTable table(scheme, 0.2, 10, default_history_length(scheme, 10), 1e-16);
  CHECK(worst_difference(table, scheme, 10) < 3e-12);
}

TEST_CASE("weights of damped materials") {
  for (const char* name : {"bdf1", "radau2", "radau3"}) {
    const Scheme scheme = Scheme::parse(name);
    const int last = 40;
    const Damping damping{0.3}, faint{1e-11};
    const RadialTable table(scheme, 0.2, 3.5, last, 1e-10, damping);
    CHECK(worst_difference(table, scheme, 3.5, damping) < 2e-10);
    CHECK(worst_difference(table, scheme, 3.5, {}) > 1e-3);
    const RadialTable without(scheme, 0.2, 3.5, last, 1e-10, faint);
    CHECK(worst_difference(without, scheme, 3.5, {}) < 1e-8);
    // all weights add up to the static function, which damping does not change
    const std::vector<double> factors = static_lane_factors(scheme, table.layout());
    const RadialValues<double> rest = static_radial_values(0.2);
    const RadialWeights weights(scheme, 0.2, last, damping);
    std::vector<double> values(kRadialCount * table.layout().count());
    weights.evaluate(2.1, values.data());
    for (int f = 0; f < kRadialCount; ++f) {
      double sum = 0;
      for (std::size_t lane = 0; lane < factors.size(); ++lane)
        sum += factors[lane] * values[f * factors.size() + lane];
      CHECK(std::abs(sum - rest[f]) < 1e-12);
    }
  }
}

TEST_CASE("the contour formula reproduces the closed form of BDF1") {
  const double kappa = 0.2;
  const int last = 20;
  const ContourQuadrature contour(Scheme::multistep(0), last);
  std::vector<double> lanes(kRadialCount * contour.layout().count());
  for (double lam : {1e-6, 0.4, 3.0, 11.0}) {
    const auto functions = [&](Complex d, Complex* value) {
      const auto v = radial_values(d * lam, kappa);
      std::copy(v.begin(), v.end(), value);
    };
    contour.weights(kRadialCount, functions, lanes.data());
    const auto closed = bdf1_radial_weights(lam, kappa, last);
    for (int f = 0; f < kRadialCount; ++f)
      for (int k = 0; k <= last; ++k)
        CHECK(std::abs(lanes[f * contour.layout().count() + k] - closed[k][f]) < 2e-13);
  }
}

TEST_CASE("lanes that do not count are nothing beside those that do") {
  const RadialTable table(Scheme::parse("radau2"), 0.3, 30, 36, 1e-9, {}, hypersingular_family());
  const LaneTable<float> lanes = table.single_precision();
  std::vector<double> values(static_cast<std::size_t>(lanes.functions) * lanes.padded_lanes);
  REQUIRE(lanes.used_lanes.size() == static_cast<std::size_t>(lanes.intervals));
  for (int i = 0; i < lanes.intervals; ++i)
    for (double place : {0.1, 0.5, 0.9}) {
      lanes.evaluate(lanes.lam_at(i + place), values.data());
      for (int f = 0; f < lanes.functions; ++f) {
        const Eigen::Map<const Eigen::VectorXd> of_lanes(
            &values[std::size_t(f) * lanes.padded_lanes], lanes.padded_lanes);
        const int rest = lanes.padded_lanes - lanes.used_lanes[i];
        if (rest > 0)
          CHECK(of_lanes.tail(rest).cwiseAbs().maxCoeff() < 1e-7 * of_lanes.cwiseAbs().maxCoeff());
      }
    }
  CHECK(lanes.used_lanes.front() < lanes.padded_lanes / 3);  // waves have come as far as two lags
  CHECK(lanes.used_lanes.back() == lanes.padded_lanes);
}
