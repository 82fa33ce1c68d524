#pragma once

#include "base/aligned.hpp"
#include "kernels/contour.hpp"
#include "kernels/radial_functions.hpp"

#include <vector>

namespace bem {

/// All convolution quadrature weights of all radial functions as piecewise polynomials of
/// lam = r/(c2 dt): one look-up and one Horner scheme per quadrature point give every lag at once.
/// The last lag carries the sum of all later weights (M25).
class RadialTable {
 public:
  static constexpr int kNodes = 8;        ///< polynomial coefficients per interval
  static constexpr int kLanePadding = 8;  ///< lanes are padded to a multiple of this

  /// Tabulates 0 <= lam <= lam_max to an interpolation error <= tolerance (of values of order one;
  /// checked against direct evaluation between the nodes). Cost: a few thousand short transforms.
  RadialTable(const Scheme& scheme, double kappa, double lam_max, int last_lag,
              double tolerance = 1e-10);

  const LaneLayout& layout() const { return layout_; }
  double kappa() const { return kappa_; }
  int intervals() const { return intervals_; }
  int padded_lanes() const { return padded_lanes_; }
  double intervals_per_lam() const { return intervals_per_lam_; }

  /// Coefficients [function][degree][padded lane] of an interval, in its local variable in [-1, 1].
  const double* coefficients(int interval) const {
    return coefficients_.data() + static_cast<std::size_t>(interval) * interval_size();
  }
  std::size_t interval_size() const {
    return static_cast<std::size_t>(kRadialCount) * kNodes * padded_lanes_;
  }

  /// Interpolated values out[function*padded_lanes() + lane].
  void evaluate(double lam, double* out) const;

  /// Static part of P, Q or S by padded lane (in the real lanes of lag 0; zero for other
  /// functions): what the singular integrals treat analytically.
  const double* static_part(int function) const {
    return static_parts_.data() + static_cast<std::size_t>(function) * padded_lanes_;
  }
  /// Lanes of lag 0 that hold real parts.
  const std::vector<int>& static_lanes() const { return static_lanes_; }

 private:
  void build(const Scheme& scheme, double lam_max);
  void set_static_parts(const Scheme& scheme);
  double interpolation_error(const Scheme& scheme, double lam_max) const;

  LaneLayout layout_;
  double kappa_;
  int padded_lanes_;
  int intervals_ = 0;
  double intervals_per_lam_ = 0;
  AlignedVector coefficients_, static_parts_;
  std::vector<int> static_lanes_;
};

/// Direct evaluation of what RadialTable tabulates, out[function*layout.count() + lane]: closed
/// form for BDF1, contour formula for every other scheme.
class RadialWeights {
 public:
  RadialWeights(const Scheme& scheme, double kappa, int last_lag);
  void evaluate(double lam, double* out) const;
  const LaneLayout& layout() const { return contour_.layout(); }

 private:
  void evaluate_bdf1(double lam, double* out) const;

  ContourQuadrature contour_;
  bool closed_form_;
  double kappa_;
};

}  // namespace bem
