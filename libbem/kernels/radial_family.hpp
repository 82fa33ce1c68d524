#pragma once

#include "base/types.hpp"

namespace bem {

/// Entire functions of z = s r/c2 whose weights are tabulated together: what the kernels of a
/// discretisation are made of. kappa = (c2/c1)^2.
struct RadialFamily {
  int count;
  void (*values)(Complex z, double kappa, Complex* out);
  /// By function: the power of m = 1 + s time that a damped material divides it by (its argument is
  /// divided by the root of m).
  const int* modulus_powers;
  /// By function: the static part that singular integrals treat on their own, or zero.
  void (*static_parts)(double kappa, double* out);
  bool has_bdf1_weights;  ///< in closed form (kernels/bdf1_weights.hpp)
};

/// RadialFunction: displacement, traction and body-force kernels of collocation.
const RadialFamily& collocation_family();
/// HypersingularFunction: hypersingular and adjoint double layer kernels of the Galerkin method.
const RadialFamily& hypersingular_family();

}  // namespace bem
