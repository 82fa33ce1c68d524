#pragma once

#include "base/aligned.hpp"
#include "base/material.hpp"
#include "kernels/contour.hpp"
#include "kernels/radial_family.hpp"

#include <cmath>
#include <vector>

namespace bem {

/// Piecewise polynomials for all radial functions and all lanes: one look-up and one Horner scheme
/// per quadrature point give every lag at once. T is double, or float for far pairs at moderate
/// tolerances.
///
/// The weights change fastest near lam = r/(c2 dt) = 0, and so the intervals are narrower there:
/// they are equal in (lam + kGrading)^(3/4), which the polynomials are in.
template <class T>
struct LaneTable {
  static constexpr int kNodes = 8;  ///< polynomial coefficients per interval
  static constexpr double kGrading = 0.2;
  static constexpr int kLanePadding = 8;

  int functions = 0;
  int lanes = 0;
  int padded_lanes = 0;
  int intervals = 0;
  double scale = 0;               ///< intervals per unit of the graded variable
  AlignedVector<T> coefficients;  ///< [interval][function][degree][padded lane]
  AlignedVector<T> static_parts;  ///< [function][padded lane], see static_part()
  std::vector<int> used_lanes;    ///< by interval, see find_used_lanes()

  void set_size(int function_count, int count) {
    functions = function_count;
    lanes = count;
    padded_lanes = (count + kLanePadding - 1) / kLanePadding * kLanePadding;
  }
  std::size_t interval_size() const {
    return static_cast<std::size_t>(functions) * kNodes * padded_lanes;
  }
  static double graded(double lam) {
    const double root = std::sqrt(lam + kGrading);
    return root * std::sqrt(root);
  }
  /// Number of the interval that holds lam, and in its fraction the place in it.
  double position(double lam) const { return scale * (graded(lam) - graded(0)); }
  double lam_at(double position) const {
    return std::pow(position / scale + graded(0), 4.0 / 3) - kGrading;
  }
  /// Coefficients of an interval, in its local variable in [-1, 1].
  const T* interval(int index) const { return coefficients.data() + index * interval_size(); }
  /// Static part of a function by lane (in the real lanes of lag 0): what the singular integrals
  /// treat on its own.
  const T* static_part(int function) const {
    return static_parts.data() + static_cast<std::size_t>(function) * padded_lanes;
  }
  /// Finds how many lanes count in each interval, a multiple of kLanePadding: all later ones are
  /// zero to an eighth of rounding beside the largest one of their function. A short way concerns
  /// few lags.
  void find_used_lanes();
  /// How many lanes count at any distance up to this one.
  int lanes_within(double lam) const;
  /// Interpolated values out[function*padded_lanes + lane].
  void evaluate(double lam, double* out) const;
};

/// Direct evaluation of what RadialTable tabulates, out[function*layout.count() + lane]: closed
/// form for BDF1 without damping where there is one, contour formula for everything else. The
/// moduli of a damped material are m = 1 + s time times those of an elastic one, so that its
/// kernels are those of the argument s r/(c2 sqrt(m)), divided by powers of m.
class RadialWeights {
 public:
  RadialWeights(const Scheme& scheme, double kappa, int last_lag, const Damping& damping = {},
                const RadialFamily& family = collocation_family());
  void evaluate(double lam, double* out) const;
  const LaneLayout& layout() const { return contour_.layout(); }
  const RadialFamily& family() const { return family_; }

 private:
  void evaluate_bdf1(double lam, double* out) const;

  ContourQuadrature contour_;
  bool closed_form_;
  double kappa_;
  Damping damping_;
  const RadialFamily& family_;
};

/// All convolution quadrature weights of all functions of a family, tabulated. The last lag carries
/// the sum of all later weights (M25): lag 0 alone is the static function.
class RadialTable {
 public:
  /// Tabulates 0 <= lam <= lam_max to an interpolation error <= tolerance, or about rounding (of
  /// values of order one; checked against direct evaluation between the nodes). `damping`: its time
  /// in units of dt. Cost: some hundred to some thousand short transforms.
  RadialTable(const Scheme& scheme, double kappa, double lam_max, int last_lag,
              double tolerance = 1e-10, const Damping& damping = {},
              const RadialFamily& family = collocation_family());

  const LaneLayout& layout() const { return layout_; }
  double kappa() const { return kappa_; }
  const LaneTable<double>& lanes() const { return lanes_; }
  /// The same rounded to single precision.
  LaneTable<float> single_precision() const;
  /// Lanes of lag 0 that hold real parts.
  const std::vector<int>& static_lanes() const { return static_lanes_; }

 private:
  void set_intervals(int count, double lam_max);
  void tabulate(const RadialWeights& weights, int interval, double* out) const;
  double error(const RadialWeights& weights, int interval, const double* coefficients) const;
  int sampled_intervals(const RadialWeights& weights, double lam_max, double tolerance);
  void build(const RadialWeights& weights);
  void set_static_parts(const Scheme& scheme, const RadialFamily& family);
  double largest_error(const RadialWeights& weights) const;

  LaneLayout layout_;
  double kappa_;
  LaneTable<double> lanes_;
  std::vector<int> static_lanes_;
};

}  // namespace bem
