#include "kernels/radial_table.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "kernels/bdf1_weights.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bem {
namespace {

constexpr int kNodes = RadialTable::kNodes;

double chebyshev_node(int i) {
  return std::cos(kPi * (2 * i + 1) / (2 * kNodes));
}

/// Maps values at the Chebyshev nodes to monomial coefficients.
Eigen::Matrix<double, kNodes, kNodes> interpolation_matrix() {
  Eigen::Matrix<double, kNodes, kNodes> vandermonde;
  for (int i = 0; i < kNodes; ++i)
    for (int j = 0; j < kNodes; ++j) vandermonde(i, j) = std::pow(chebyshev_node(i), j);
  return vandermonde.inverse();
}

}  // namespace

RadialWeights::RadialWeights(const Scheme& scheme, double kappa, int last_lag)
    : contour_(scheme, last_lag),
      closed_form_(scheme.is_multistep() && scheme.theta() == 0),
      kappa_(kappa) {}

void RadialWeights::evaluate(double lam, double* out) const {
  if (closed_form_ && lam < 600) {
    evaluate_bdf1(lam, out);
    return;
  }
  const auto functions = [lam, this](Complex d, Complex* value) {
    const RadialValues<Complex> v = radial_values(d * lam, kappa_);
    std::copy(v.begin(), v.end(), value);
  };
  contour_.weights(kRadialCount, functions, out, true);
}

void RadialWeights::evaluate_bdf1(double lam, double* out) const {
  const int last = layout().last_lag;
  const auto weights = bdf1_radial_weights(lam, kappa_, last);
  const RadialValues<double> total = static_radial_values(kappa_);
  for (int f = 0; f < kRadialCount; ++f) {
    double sum = 0;
    for (int k = 0; k <= last; ++k) {
      out[f * layout().count() + k] = weights[k][f];
      sum += weights[k][f];
    }
    out[f * layout().count() + last] += total[f] - sum;
  }
}

RadialTable::RadialTable(const Scheme& scheme, double kappa, double lam_max, int last_lag,
                         double tolerance)
    : layout_(scheme, last_lag), kappa_(kappa) {
  require(lam_max > 0, "the table covers a positive range");
  padded_lanes_ = (layout_.count() + kLanePadding - 1) / kLanePadding * kLanePadding;
  set_static_parts(scheme);
  constexpr int kMostRefinements = 6;
  intervals_ = std::max(1, static_cast<int>(std::ceil(2 * lam_max)));
  for (int refinement = 0;; ++refinement, intervals_ *= 2) {
    build(scheme, lam_max);
    if (interpolation_error(scheme, lam_max) <= tolerance) return;
    require(refinement < kMostRefinements, "the radial table reaches its tolerance");
  }
}

void RadialTable::set_static_parts(const Scheme& scheme) {
  static_parts_.assign(static_cast<std::size_t>(kRadialCount) * padded_lanes_, 0.0);
  const RadialValues<double> rest = static_radial_values(kappa_);
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    static_lanes_.push_back(lane);
    for (int f : {kRadialP, kRadialQ, kRadialS}) static_parts_[f * padded_lanes_ + lane] = rest[f];
    lane += c.paired ? 2 : 1;
  }
}

void RadialTable::build(const Scheme& scheme, double lam_max) {
  intervals_per_lam_ = intervals_ / lam_max;
  coefficients_.assign(intervals_ * interval_size(), 0.0);
  const Eigen::Matrix<double, kNodes, kNodes> to_monomials = interpolation_matrix();
  const RadialWeights weights(scheme, kappa_, layout_.last_lag);
  const int lanes = layout_.count();
  parallel_for(intervals_, [&](std::size_t interval) {
    std::vector<double> values(static_cast<std::size_t>(kNodes) * kRadialCount * lanes);
    for (int i = 0; i < kNodes; ++i) {
      const double lam = (interval + 0.5 * (1 + chebyshev_node(i))) / intervals_per_lam_;
      weights.evaluate(lam, &values[static_cast<std::size_t>(i) * kRadialCount * lanes]);
    }
    double* out = &coefficients_[interval * interval_size()];
    for (int f = 0; f < kRadialCount; ++f)
      for (int lane = 0; lane < lanes; ++lane)
        for (int degree = 0; degree < kNodes; ++degree) {
          double sum = 0;
          for (int i = 0; i < kNodes; ++i)
            sum += to_monomials(degree, i) * values[(i * kRadialCount + f) * lanes + lane];
          out[(f * kNodes + degree) * padded_lanes_ + lane] = sum;
        }
  });
}

void RadialTable::evaluate(double lam, double* out) const {
  const double position = lam * intervals_per_lam_;
  const int interval = std::min(static_cast<int>(position), intervals_ - 1);
  const double t = 2 * (position - interval) - 1;
  const double* c = coefficients(interval);
  for (int f = 0; f < kRadialCount; ++f)
    for (int lane = 0; lane < padded_lanes_; ++lane) {
      double value = 0;
      for (int degree = kNodes - 1; degree >= 0; --degree)
        value = value * t + c[(f * kNodes + degree) * padded_lanes_ + lane];
      out[f * padded_lanes_ + lane] = value;
    }
}

double RadialTable::interpolation_error(const Scheme& scheme, double lam_max) const {
  const RadialWeights weights(scheme, kappa_, layout_.last_lag);
  const int lanes = layout_.count();
  std::vector<double> errors(intervals_, 0.0);
  parallel_for(intervals_, [&](std::size_t interval) {
    std::vector<double> exact(static_cast<std::size_t>(kRadialCount) * lanes);
    std::vector<double> table(static_cast<std::size_t>(kRadialCount) * padded_lanes_);
    for (double t : {0.001, 0.3}) {  // next to an end, where the node polynomial peaks, and inside
      const double lam = (interval + t) * lam_max / intervals_;
      weights.evaluate(lam, exact.data());
      evaluate(lam, table.data());
      for (int f = 0; f < kRadialCount; ++f)
        for (int lane = 0; lane < lanes; ++lane)
          errors[interval] = std::max(errors[interval], std::abs(table[f * padded_lanes_ + lane] -
                                                                 exact[f * lanes + lane]));
    }
  });
  return *std::max_element(errors.begin(), errors.end());
}

}  // namespace bem
