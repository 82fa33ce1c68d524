#include "kernels/moments.hpp"

namespace bem {

Moments exponential_moments(Complex z) {
  constexpr double kSwitch = 2.0;
  constexpr int kSeriesFactors = 22;
  Moments m;
  m.e = std::exp(-z);
  if (std::norm(z) < kSwitch * kSwitch) {
    Complex series = 1.0;
    for (int n = kSeriesFactors; n >= 1; --n) series = 1.0 + z / (n + 4.0) * series;
    m.m3 = m.e / 4.0 * series;
    m.m2 = (z * m.m3 + m.e) / 3.0;
    m.m1 = (z * m.m2 + m.e) / 2.0;
    m.m0 = z * m.m1 + m.e;
    m.zz_m1 = z * z * m.m1;
    m.zz_m3 = z * z * m.m3;
  } else {
    m.m0 = (1.0 - m.e) / z;
    m.m1 = (m.m0 - m.e) / z;
    m.m2 = (2.0 * m.m1 - m.e) / z;
    m.m3 = (3.0 * m.m2 - m.e) / z;
    m.zz_m1 = 1.0 - (1.0 + z) * m.e;
    m.zz_m3 = 6.0 * m.m1 - (3.0 + z) * m.e;
  }
  return m;
}

}  // namespace bem
