#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

/// The functions of z2 = s r/c2 that multiply the tensors of the four kernels.
enum RadialFunction : int {
  kRadialA,   ///< a   of the displacement kernel u*   (M3)
  kRadialB,   ///< b   of the displacement kernel u*   (M3)
  kRadialP,   ///< P   of the traction kernel p*       (M4)
  kRadialQ,   ///< Q   of the traction kernel p*       (M4)
  kRadialS,   ///< S   of the traction kernel p*       (M4)
  kRadialF,   ///< F   of the body-force kernels d*, l* (M5), (M6)
  kRadialM1,  ///< M_1(z2) of d*                       (M5)
  kRadialM0,  ///< M_0(z2) of l* and m*                (M6), (M7)
  kRadialC0,  ///< kappa M_0(z1) of m*                 (M7)
  kRadialCount
};

template <class Scalar>
using RadialValues = std::array<Scalar, kRadialCount>;

/// Values at s = 0 (Kelvin's static kernels); kappa = (c2/c1)^2 in [0, 3/4).
RadialValues<double> static_radial_values(double kappa);

/// Values at z2 = s r/c2, Re z2 >= 0, accurate to about 4e-15 of the static size for any |z2|,
/// including nu = 0.5 (kappa = 0)  (M3)-(M6).
RadialValues<Complex> radial_values(Complex z2, double kappa);

}  // namespace bem
