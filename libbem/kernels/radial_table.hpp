#pragma once

#include "base/aligned.hpp"
#include "base/material.hpp"
#include "kernels/contour.hpp"
#include "kernels/radial_functions.hpp"

#include <vector>

namespace bem {

/// Piecewise polynomials of lam = r/(c2 dt) for all radial functions and all lanes: one look-up and
/// one Horner scheme per quadrature point give every lag at once. T is double, or float for far
/// pairs at moderate tolerances.
template <class T>
struct LaneTable {
  static constexpr int kNodes = 8;                     ///< polynomial coefficients per interval
  static constexpr int kLanePadding = 64 / sizeof(T);  ///< lanes fill whole cache lines

  int lanes = 0;
  int padded_lanes = 0;
  int intervals = 0;
  double intervals_per_lam = 0;
  AlignedVector<T> coefficients;  ///< [interval][function][degree][padded lane]
  AlignedVector<T> static_parts;  ///< [function][padded lane]: static P, Q, S, see static_part()

  void set_lanes(int count) {
    lanes = count;
    padded_lanes = (count + kLanePadding - 1) / kLanePadding * kLanePadding;
  }
  std::size_t interval_size() const {
    return static_cast<std::size_t>(kRadialCount) * kNodes * padded_lanes;
  }
  /// Coefficients of an interval, in its local variable in [-1, 1].
  const T* interval(int index) const { return coefficients.data() + index * interval_size(); }
  /// Static part of P, Q or S by lane (in the real lanes of lag 0; zero for the other functions):
  /// what the singular integrals treat analytically.
  const T* static_part(int function) const {
    return static_parts.data() + static_cast<std::size_t>(function) * padded_lanes;
  }
  /// Interpolated values out[function*padded_lanes + lane].
  void evaluate(double lam, double* out) const;
};

/// All convolution quadrature weights of all radial functions, tabulated. The last lag carries the
/// sum of all later weights (M25): lag 0 alone is the static function.
class RadialTable {
 public:
  /// Tabulates 0 <= lam <= lam_max to an interpolation error <= tolerance (of values of order one;
  /// checked against direct evaluation between the nodes). `damping`: its time in units of dt.
  /// Cost: a few thousand short transforms.
  RadialTable(const Scheme& scheme, double kappa, double lam_max, int last_lag,
              double tolerance = 1e-10, const Damping& damping = {});

  const LaneLayout& layout() const { return layout_; }
  double kappa() const { return kappa_; }
  const LaneTable<double>& lanes() const { return lanes_; }
  /// The same rounded to single precision.
  LaneTable<float> single_precision() const;
  /// Lanes of lag 0 that hold real parts.
  const std::vector<int>& static_lanes() const { return static_lanes_; }

 private:
  void build(const Scheme& scheme, double lam_max);
  void set_static_parts(const Scheme& scheme);
  double interpolation_error(const Scheme& scheme, double lam_max) const;

  LaneLayout layout_;
  double kappa_;
  Damping damping_;
  LaneTable<double> lanes_;
  std::vector<int> static_lanes_;
};

/// Direct evaluation of what RadialTable tabulates, out[function*layout.count() + lane]: closed
/// form for BDF1 without damping, contour formula for everything else. The moduli of a damped
/// material are m = 1 + s time times those of an elastic one, so that its kernels are those
/// of the argument s r/(c2 sqrt(m)), and those that have a modulus in their scale (u*, d*, l*, m*)
/// are divided by m.
class RadialWeights {
 public:
  RadialWeights(const Scheme& scheme, double kappa, int last_lag, const Damping& damping = {});
  void evaluate(double lam, double* out) const;
  const LaneLayout& layout() const { return contour_.layout(); }

 private:
  void evaluate_bdf1(double lam, double* out) const;

  ContourQuadrature contour_;
  bool closed_form_;
  double kappa_;
  Damping damping_;
};

}  // namespace bem
