#include "kernels/hypersingular_functions.hpp"

#include "kernels/moments.hpp"
#include "kernels/radial_family.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

HypersingularValues<Complex> hypersingular_values(Complex z, double kappa) {
  const double k = kappa, kk = k * k, shear = 1 - 2 * k;
  const Moments s = exponential_moments(z);                 // shear wave
  const Moments c = exponential_moments(std::sqrt(k) * z);  // compression wave
  const Complex f2 = 3.0 * s.m1 - 5.0 * s.m3, f1 = 3.0 * c.m1 - 5.0 * c.m3;
  const Complex q2 = 15.0 * s.m1 - 35.0 * s.m3 + 2.0 * s.e;
  const Complex q1 = 15.0 * c.m1 - 35.0 * c.m3 + 2.0 * c.e;
  const Complex difference = (s.m1 - s.m3) - kk * (c.m1 - c.m3);
  HypersingularValues<Complex> v;
  v[kAlpha] = 2.0 * (s.m3 + kk * (c.m1 - c.m3));
  v[kBeta] = s.e - 3.0 * s.m1 + 2.0 * f2 - 2.0 * kk * f1;
  v[kGamma] = shear * shear * c.e + 4.0 * k * shear * c.m1 - 2.0 * difference;
  v[kDelta] = -2.0 * k * shear * (3.0 * c.m1 - c.e) + 2.0 * f2 - 2.0 * kk * f1;
  v[kEpsilon] = -2.0 * (q2 - kk * q1);
  v[kDynamicP] = 0.5 * v[kAlpha];
  v[kDynamicQ] = k * shear * c.m1 - difference;
  v[kDynamicS] = f2 - kk * f1;
  v[kDilation] = c.m1;
  return v;
}

const RadialFamily& hypersingular_family() {
  // the equations of a damped material are divided by m: Z by m, J by its square
  static const int powers[kHypersingularCount] = {1, 1, 1, 1, 1, 2, 2, 2, 2};
  static const RadialFamily family = {
      kHypersingularCount,
      [](Complex z, double kappa, Complex* out) {
        const HypersingularValues<Complex> v = hypersingular_values(z, kappa);
        std::copy(v.begin(), v.end(), out);
      },
      powers, [](double, double* out) { std::fill(out, out + kHypersingularCount, 0.0); }, false};
  return family;
}

}  // namespace bem
