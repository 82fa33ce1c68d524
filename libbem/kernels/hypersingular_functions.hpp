#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

/// The entire functions of z = s r/c2 that multiply the tensors of the dynamic parts of the
/// hypersingular kernel, D(s) = D(0) + s^2 Z(s), and of the adjoint double layer kernel, K'(s) =
/// K'(0) + (s/c2)^2 J(s); see tests/support/galerkin_kernels.hpp. M_n(z), M_n(z1) and e are those
/// of kernels/moments.hpp.
enum HypersingularFunction : int {
  kAlpha,
  kBeta,
  kGamma,
  kDelta,
  kEpsilon,
  kDynamicP,  ///< (P(z) - P(0))/z^2 of the traction kernel (M4): alpha/2
  kDynamicQ,  ///< (Q(z) - Q(0))/z^2 of the traction kernel (M4)
  kDynamicS,  ///< (S(z) - S(0))/z^2 of the traction kernel (M4)
  kDilation,  ///< M_1(z1): J of a uniform pressure
  kHypersingularCount
};

template <class Scalar>
using HypersingularValues = std::array<Scalar, kHypersingularCount>;

/// Values at z = s r/c2, Re z >= 0, without loss of more than a digit for any |z|; kappa =
/// (c2/c1)^2 in [0, 3/4), nu = 0.5 (kappa = 0) included.
HypersingularValues<Complex> hypersingular_values(Complex z, double kappa);

/// Static values Q(0) = -P(0) = kappa and S(0) of the traction kernel (M4).
struct StaticTraction {
  explicit StaticTraction(double kappa) : p(-kappa), q(kappa), s(-3 * (1 - kappa)) {}
  double p, q, s;
};

}  // namespace bem
