#include "kernels/radial_functions.hpp"

#include "kernels/moments.hpp"
#include "kernels/radial_family.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

RadialValues<double> static_radial_values(double kappa) {
  RadialValues<double> v;
  v[kRadialA] = 0.5 * (1 + kappa);
  v[kRadialB] = -0.5 * (1 - kappa);
  v[kRadialP] = -kappa;
  v[kRadialQ] = kappa;
  v[kRadialS] = -3 * (1 - kappa);
  v[kRadialF] = 0.5 * (1 - kappa);
  v[kRadialM1] = 0.5;
  v[kRadialM0] = 1.0;
  v[kRadialC0] = kappa;
  return v;
}

RadialValues<Complex> radial_values(Complex z2, double kappa) {
  const double k = kappa;
  const Moments s = exponential_moments(z2);                 // shear wave
  const Moments c = exponential_moments(std::sqrt(k) * z2);  // compression wave
  const RadialValues<double> rest = static_radial_values(k);
  const Complex shear = s.zz_m1 - s.zz_m3;
  const Complex compression = k * (c.zz_m1 - c.zz_m3);
  RadialValues<Complex> v;
  v[kRadialA] = s.e - s.m1 + k * c.m1;
  v[kRadialB] = rest[kRadialB] + 0.5 * (shear - compression);
  v[kRadialP] = rest[kRadialP] + s.zz_m3 + compression;
  v[kRadialQ] = rest[kRadialQ] - shear + compression + (1 - 2 * k) * c.zz_m1;
  v[kRadialS] =
      rest[kRadialS] + (3.0 * s.zz_m1 - 5.0 * s.zz_m3) - k * (3.0 * c.zz_m1 - 5.0 * c.zz_m3);
  v[kRadialF] = s.m1 - k * c.m1;
  v[kRadialM1] = s.m1;
  v[kRadialM0] = s.m0;
  v[kRadialC0] = k * c.m0;
  return v;
}

const RadialFamily& collocation_family() {
  static const int powers[kRadialCount] = {1, 1, 0, 0, 0, 1, 1, 1, 1};
  static const RadialFamily family = {kRadialCount,
                                      [](Complex z, double kappa, Complex* out) {
                                        const RadialValues<Complex> v = radial_values(z, kappa);
                                        std::copy(v.begin(), v.end(), out);
                                      },
                                      powers,
                                      [](double kappa, double* out) {
                                        const RadialValues<double> rest =
                                            static_radial_values(kappa);
                                        std::fill(out, out + kRadialCount, 0.0);
                                        for (int f : {kRadialP, kRadialQ, kRadialS})
                                          out[f] = rest[f];
                                      },
                                      true};
  return family;
}

}  // namespace bem
