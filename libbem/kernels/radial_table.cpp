#include "kernels/radial_table.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "kernels/bdf1_weights.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace bem {
namespace {

constexpr int kNodes = LaneTable<double>::kNodes;

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

RadialWeights::RadialWeights(const Scheme& scheme, double kappa, int last_lag,
                             const Damping& damping)
    : contour_(scheme, last_lag),
      closed_form_(scheme.is_multistep() && scheme.theta() == 0 && damping.time == 0),
      kappa_(kappa),
      damping_(damping) {}

void RadialWeights::evaluate(double lam, double* out) const {
  if (closed_form_ && lam < 600) {
    evaluate_bdf1(lam, out);
    return;
  }
  const auto functions = [lam, this](Complex d, Complex* value) {
    const Complex m = 1.0 + damping_.time * d;
    const RadialValues<Complex> v = radial_values(d * lam / std::sqrt(m), kappa_);
    std::copy(v.begin(), v.end(), value);
    for (int f : {kRadialA, kRadialB, kRadialF, kRadialM1, kRadialM0, kRadialC0}) value[f] /= m;
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
                         double tolerance, const Damping& damping)
    : layout_(scheme, last_lag), kappa_(kappa), damping_(damping) {
  require(lam_max > 0, "the table covers a positive range");
  lanes_.set_lanes(layout_.count());
  set_static_parts(scheme);
  constexpr int kMostRefinements = 6;
  lanes_.intervals = std::max(1, static_cast<int>(std::ceil(2 * lam_max)));
  for (int refinement = 0;; ++refinement, lanes_.intervals *= 2) {
    build(scheme, lam_max);
    if (interpolation_error(scheme, lam_max) <= tolerance) return;
    require(refinement < kMostRefinements, "the radial table reaches its tolerance");
  }
}

void RadialTable::set_static_parts(const Scheme& scheme) {
  lanes_.static_parts.assign(static_cast<std::size_t>(kRadialCount) * lanes_.padded_lanes, 0.0);
  const RadialValues<double> rest = static_radial_values(kappa_);
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    static_lanes_.push_back(lane);
    for (int f : {kRadialP, kRadialQ, kRadialS})
      lanes_.static_parts[f * lanes_.padded_lanes + lane] = rest[f];
    lane += c.paired ? 2 : 1;
  }
}

void RadialTable::build(const Scheme& scheme, double lam_max) {
  lanes_.intervals_per_lam = lanes_.intervals / lam_max;
  lanes_.coefficients.assign(lanes_.intervals * lanes_.interval_size(), 0.0);
  const Eigen::Matrix<double, kNodes, kNodes> to_monomials = interpolation_matrix();
  const RadialWeights weights(scheme, kappa_, layout_.last_lag, damping_);
  const int count = layout_.count();
  parallel_for(lanes_.intervals, [&](std::size_t interval) {
    std::vector<double> values(static_cast<std::size_t>(kNodes) * kRadialCount * count);
    for (int i = 0; i < kNodes; ++i) {
      const double lam = (interval + 0.5 * (1 + chebyshev_node(i))) / lanes_.intervals_per_lam;
      weights.evaluate(lam, &values[static_cast<std::size_t>(i) * kRadialCount * count]);
    }
    double* out = &lanes_.coefficients[interval * lanes_.interval_size()];
    for (int f = 0; f < kRadialCount; ++f)
      for (int lane = 0; lane < count; ++lane)
        for (int degree = 0; degree < kNodes; ++degree) {
          double sum = 0;
          for (int i = 0; i < kNodes; ++i)
            sum += to_monomials(degree, i) * values[(i * kRadialCount + f) * count + lane];
          out[(f * kNodes + degree) * lanes_.padded_lanes + lane] = sum;
        }
  });
}

template <class T>
void LaneTable<T>::evaluate(double lam, double* out) const {
  const double position = lam * intervals_per_lam;
  const int index = std::min(static_cast<int>(position), intervals - 1);
  const double t = 2 * (position - index) - 1;
  const T* c = interval(index);
  for (int f = 0; f < kRadialCount; ++f)
    for (int lane = 0; lane < padded_lanes; ++lane) {
      double value = 0;
      for (int degree = kNodes - 1; degree >= 0; --degree)
        value = value * t + c[(f * kNodes + degree) * padded_lanes + lane];
      out[f * padded_lanes + lane] = value;
    }
}

template struct LaneTable<float>;
template struct LaneTable<double>;

LaneTable<float> RadialTable::single_precision() const {
  LaneTable<float> narrow;
  narrow.set_lanes(lanes_.lanes);
  narrow.intervals = lanes_.intervals;
  narrow.intervals_per_lam = lanes_.intervals_per_lam;
  const auto convert = [&](const AlignedVector<double>& from, AlignedVector<float>& to) {
    const std::size_t rows = from.size() / lanes_.padded_lanes;
    to.assign(rows * narrow.padded_lanes, 0.0f);
    for (std::size_t r = 0; r < rows; ++r)
      for (int lane = 0; lane < lanes_.lanes; ++lane)
        to[r * narrow.padded_lanes + lane] =
            static_cast<float>(from[r * lanes_.padded_lanes + lane]);
  };
  convert(lanes_.coefficients, narrow.coefficients);
  convert(lanes_.static_parts, narrow.static_parts);
  return narrow;
}

double RadialTable::interpolation_error(const Scheme& scheme, double lam_max) const {
  const RadialWeights weights(scheme, kappa_, layout_.last_lag, damping_);
  const int count = layout_.count();
  std::vector<double> errors(lanes_.intervals, 0.0);
  parallel_for(lanes_.intervals, [&](std::size_t interval) {
    std::vector<double> exact(static_cast<std::size_t>(kRadialCount) * count);
    std::vector<double> table(static_cast<std::size_t>(kRadialCount) * lanes_.padded_lanes);
    for (double t : {0.001, 0.3}) {  // next to an end, where the node polynomial peaks, and inside
      const double lam = (interval + t) * lam_max / lanes_.intervals;
      weights.evaluate(lam, exact.data());
      lanes_.evaluate(lam, table.data());
      for (int f = 0; f < kRadialCount; ++f)
        for (int lane = 0; lane < count; ++lane)
          errors[interval] =
              std::max(errors[interval],
                       std::abs(table[f * lanes_.padded_lanes + lane] - exact[f * count + lane]));
    }
  });
  return *std::max_element(errors.begin(), errors.end());
}

}  // namespace bem
