#pragma once

#include "assembly/discretisation.hpp"
#include "kernels/lag_product.hpp"

namespace bem {

/// Puts the matrices of the Galerkin method together from their static and dynamic parts, lane by
/// lane (LaneLayout): H = D(0) + (s dt)^2 Z/dt^2 at lag 0, and G = (M/2 - K'(0))/m - (s dt)^2
/// J/(c2 dt)^2 at every lag, where m = 1 + s time of a damped material is already in the lanes of Z
/// and J. Later lags of H are not needed: Z multiplies accelerations (model/motion_history.hpp).
class GalerkinCombination {
 public:
  GalerkinCombination(const Discretisation& discretisation, const LaneLayout& layout);

  /// The lanes of lag 0.
  template <class S>
  void initial_h(double static_part, const S* inertia, double* out) const {
    inertial_.apply(initial_, inertia, out);
    for (int lane = 0; lane < initial_; ++lane)
      out[lane] = one_[lane] * static_part + h_scale_ * out[lane];
  }
  template <class S>
  void g(double static_part, const S* adjoint, double* out) const {
    inertial_.apply(adjoint, out);
    for (std::size_t lane = 0; lane < one_.size(); ++lane)
      out[lane] = softened_[lane] * static_part + g_scale_ * out[lane];
  }
  /// m times what is in lanes.
  template <class S>
  void damp(const S* in, double* out) const {
    damped_.apply(in, out);
  }

 private:
  LagProduct inertial_, damped_;        ///< (s dt)^2, m
  int initial_;                         ///< lanes of lag 0
  std::vector<double> one_, softened_;  ///< lanes of 1 and 1/m
  double h_scale_, g_scale_;
};

}  // namespace bem
