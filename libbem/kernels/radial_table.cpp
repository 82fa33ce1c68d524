#include "kernels/radial_table.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "kernels/bdf1_weights.hpp"
#include "kernels/radial_functions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

namespace bem {
namespace {

constexpr int kNodes = LaneTable<double>::kNodes;
constexpr double kRounding = 1e-12;  // of weights: no intervals are so narrow that errors are less

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

/// More intervals, so many that polynomials of their degree have that error.
int refined(int count, double error, double tolerance) {
  const double factor = 1.1 * std::pow(error / tolerance, 1.0 / kNodes);
  return static_cast<int>(std::ceil(count * std::clamp(factor, 1.1, 4.0)));
}

/// All functions and lanes at t in [-1, 1] of an interval.
template <class T>
void evaluate_polynomials(const T* coefficients, int functions, int padded_lanes, double t,
                          double* out) {
  for (int f = 0; f < functions; ++f)
    for (int lane = 0; lane < padded_lanes; ++lane) {
      double value = 0;
      for (int degree = kNodes - 1; degree >= 0; --degree)
        value = value * t + coefficients[(f * kNodes + degree) * padded_lanes + lane];
      out[f * padded_lanes + lane] = value;
    }
}

/// The lanes of a function's polynomials that count.
template <class T>
int used_lanes_of(const T* coefficients, int lanes, std::size_t stride) {
  std::vector<double> bounds(lanes, 0.0);
  for (int degree = 0; degree < LaneTable<T>::kNodes; ++degree)
    for (int lane = 0; lane < lanes; ++lane)
      bounds[lane] += std::fabs(static_cast<double>(coefficients[degree * stride + lane]));
  const double least =
      std::numeric_limits<T>::epsilon() / 8 * *std::max_element(bounds.begin(), bounds.end());
  while (lanes > 0 && bounds[lanes - 1] <= least) --lanes;
  return lanes;
}

}  // namespace

RadialWeights::RadialWeights(const Scheme& scheme, double kappa, int last_lag,
                             const Damping& damping, const RadialFamily& family)
    : contour_(scheme, last_lag),
      closed_form_(family.has_bdf1_weights && scheme.is_multistep() && scheme.theta() == 0 &&
                   damping.time == 0),
      kappa_(kappa),
      damping_(damping),
      family_(family) {}

void RadialWeights::evaluate(double lam, double* out) const {
  if (closed_form_ && lam < 600) {
    evaluate_bdf1(lam, out);
    return;
  }
  const auto functions = [lam, this](Complex d, Complex* value) {
    const Complex m = 1.0 + damping_.time * d;
    family_.values(d * lam / std::sqrt(m), kappa_, value);
    for (int f = 0; f < family_.count; ++f)
      for (int i = 0; i < family_.modulus_powers[f]; ++i) value[f] /= m;
  };
  contour_.weights(family_.count, functions, out, true);
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
                         double tolerance, const Damping& damping, const RadialFamily& family)
    : layout_(scheme, last_lag), kappa_(kappa) {
  require(lam_max > 0, "the table covers a positive range");
  tolerance = std::max(tolerance, kRounding);
  lanes_.set_size(family.count, layout_.count());
  set_static_parts(scheme, family);
  const RadialWeights weights(scheme, kappa, last_lag, damping, family);
  int count = sampled_intervals(weights, lam_max, tolerance);
  constexpr int kMostRefinements = 12;
  for (int refinement = 0; refinement <= kMostRefinements; ++refinement) {
    set_intervals(count, lam_max);
    build(weights);
    const double error = largest_error(weights);
    if (error <= tolerance) return;
    count = refined(count, error, tolerance);
  }
  require(false, "the radial table reaches its tolerance");
}

void RadialTable::set_intervals(int count, double lam_max) {
  lanes_.intervals = count;
  lanes_.scale = count / (lanes_.graded(lam_max) - lanes_.graded(0));
}

/// How many intervals there have to be, by some of them: the first ones, where errors are largest,
/// and the middle one.
int RadialTable::sampled_intervals(const RadialWeights& weights, double lam_max, double tolerance) {
  std::vector<double> coefficients(lanes_.interval_size());
  int count =
      std::max(1, static_cast<int>(std::ceil(4 * (lanes_.graded(lam_max) - lanes_.graded(0)))));
  for (;;) {
    set_intervals(count, lam_max);
    double worst = 0;
    for (int interval : {0, std::min(1, count - 1), count / 2}) {
      tabulate(weights, interval, coefficients.data());
      worst = std::max(worst, error(weights, interval, coefficients.data()));
    }
    if (worst <= tolerance) return count;
    count = refined(count, worst, tolerance);
  }
}

void RadialTable::set_static_parts(const Scheme& scheme, const RadialFamily& family) {
  lanes_.static_parts.assign(static_cast<std::size_t>(family.count) * lanes_.padded_lanes, 0.0);
  std::vector<double> rest(family.count);
  family.static_parts(kappa_, rest.data());
  int lane = 0;
  for (const InitialComponent& c : scheme.initial_components()) {
    static_lanes_.push_back(lane);
    for (int f = 0; f < family.count; ++f)
      lanes_.static_parts[f * lanes_.padded_lanes + lane] = rest[f];
    lane += c.paired ? 2 : 1;
  }
}

/// The coefficients of one interval.
void RadialTable::tabulate(const RadialWeights& weights, int interval, double* out) const {
  static const Eigen::Matrix<double, kNodes, kNodes> to_monomials = interpolation_matrix();
  const int count = layout_.count(), functions = lanes_.functions;
  std::vector<double> values(static_cast<std::size_t>(kNodes) * functions * count);
  for (int i = 0; i < kNodes; ++i)
    weights.evaluate(lanes_.lam_at(interval + 0.5 * (1 + chebyshev_node(i))),
                     &values[static_cast<std::size_t>(i) * functions * count]);
  for (int f = 0; f < functions; ++f)
    for (int lane = 0; lane < count; ++lane)
      for (int degree = 0; degree < kNodes; ++degree) {
        double sum = 0;
        for (int i = 0; i < kNodes; ++i)
          sum += to_monomials(degree, i) * values[(i * functions + f) * count + lane];
        out[(f * kNodes + degree) * lanes_.padded_lanes + lane] = sum;
      }
}

void RadialTable::build(const RadialWeights& weights) {
  lanes_.coefficients.assign(lanes_.intervals * lanes_.interval_size(), 0.0);
  parallel_for(lanes_.intervals, [&](std::size_t interval) {
    tabulate(weights, static_cast<int>(interval),
             &lanes_.coefficients[interval * lanes_.interval_size()]);
  });
  lanes_.find_used_lanes();
}

template <class T>
void LaneTable<T>::find_used_lanes() {
  used_lanes.assign(intervals, 0);
  const std::size_t stride = padded_lanes;
  for (int i = 0; i < intervals; ++i) {
    for (int f = 0; f < functions; ++f)
      used_lanes[i] =
          std::max(used_lanes[i], used_lanes_of(interval(i) + f * kNodes * stride, lanes, stride));
    used_lanes[i] = (used_lanes[i] + kLanePadding - 1) / kLanePadding * kLanePadding;
  }
}

template <class T>
int LaneTable<T>::lanes_within(double lam) const {
  const int last = std::min(intervals - 1, static_cast<int>(std::max(0.0, position(lam))));
  return *std::max_element(used_lanes.begin(), used_lanes.begin() + last + 1);
}

template <class T>
void LaneTable<T>::evaluate(double lam, double* out) const {
  const double place = position(lam);
  const int index = std::min(static_cast<int>(place), intervals - 1);
  evaluate_polynomials(interval(index), functions, padded_lanes, 2 * (place - index) - 1, out);
}

template struct LaneTable<float>;
template struct LaneTable<double>;

LaneTable<float> RadialTable::single_precision() const {
  LaneTable<float> narrow;
  narrow.set_size(lanes_.functions, lanes_.lanes);
  narrow.intervals = lanes_.intervals;
  narrow.scale = lanes_.scale;
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
  narrow.find_used_lanes();
  return narrow;
}

/// Of the polynomials of an interval, between their nodes.
double RadialTable::error(const RadialWeights& weights, int interval,
                          const double* coefficients) const {
  const int count = layout_.count(), padded = lanes_.padded_lanes, functions = lanes_.functions;
  std::vector<double> exact(static_cast<std::size_t>(functions) * count);
  std::vector<double> found(static_cast<std::size_t>(functions) * padded);
  double worst = 0;
  for (double t : {0.001, 0.3}) {  // next to an end, where the node polynomial peaks, and inside
    weights.evaluate(lanes_.lam_at(interval + t), exact.data());
    evaluate_polynomials(coefficients, functions, padded, 2 * t - 1, found.data());
    for (int f = 0; f < functions; ++f)
      for (int lane = 0; lane < count; ++lane)
        worst = std::max(worst, std::abs(found[f * padded + lane] - exact[f * count + lane]));
  }
  return worst;
}

double RadialTable::largest_error(const RadialWeights& weights) const {
  std::vector<double> errors(lanes_.intervals, 0.0);
  parallel_for(lanes_.intervals, [&](std::size_t i) {
    const int interval = static_cast<int>(i);
    errors[i] = error(weights, interval, lanes_.interval(interval));
  });
  return *std::max_element(errors.begin(), errors.end());
}

}  // namespace bem
