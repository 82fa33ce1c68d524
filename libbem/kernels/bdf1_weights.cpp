#include "kernels/bdf1_weights.hpp"

#include "base/error.hpp"

#include <cmath>

namespace bem {

PoissonWeights poisson_weights(double lam, int last_lag) {
  require(lam >= 0 && lam < 700 && last_lag >= 0, "0 <= lam < 700 and last_lag >= 0");
  const int last = last_lag;
  PoissonWeights w;
  w.p.resize(last + 1);
  w.h.resize(last + 1);
  w.m0.resize(last + 1);
  w.p[0] = std::exp(-lam);
  for (int k = 1; k <= last; ++k) w.p[k] = w.p[k - 1] * lam / k;

  // sum of lam^j / ((first)(first+1)...(first+j-1)), the tail beyond the last lag
  const auto tail_series = [lam](int first) {
    double sum = 1, term = 1;
    for (int j = first; term > 1e-17 * sum; ++j) {
      term *= lam / j;
      sum += term;
    }
    return sum;
  };
  double tail_h = w.p[last] / ((last + 1.0) * (last + 2.0)) * tail_series(last + 3);
  double tail_m = w.p[last] / (last + 1.0) * tail_series(last + 2);
  for (int k = last; k >= 0; --k) {
    w.h[k] = (k + 1) * tail_h;
    w.m0[k] = tail_m;
    if (k >= 1) {
      tail_h += w.p[k - 1] / (k * (k + 1.0));
      tail_m += w.p[k - 1] / k;
    }
  }
  return w;
}

std::vector<RadialValues<double>> bdf1_radial_weights(double lam, double kappa, int last_lag) {
  const double k = kappa;
  const double lam1 = std::sqrt(k) * lam;
  const PoissonWeights s = poisson_weights(lam, last_lag);
  const PoissonWeights c = poisson_weights(lam1, last_lag);
  const RadialValues<double> rest = static_radial_values(k);
  std::vector<RadialValues<double>> weights(last_lag + 1);
  for (int n = 0; n <= last_lag; ++n) {
    const double d0 = n == 0 ? 1 : 0;
    const double beta2 = 2 * s.p[n] - 6 * s.h[n] + d0;
    const double beta1 = 2 * c.p[n] - 6 * c.h[n] + d0;
    const double gamma2 = (3 + lam - n) * s.p[n] - 6 * s.h[n];
    const double gamma1 = (3 + lam1 - n) * c.p[n] - 6 * c.h[n];
    RadialValues<double>& w = weights[n];
    w[kRadialA] = s.p[n] - s.h[n] + k * c.h[n];
    w[kRadialB] = 0.5 * (beta2 - k * beta1) + d0 * rest[kRadialB];
    w[kRadialP] = -gamma2 + k * beta1 + d0 * rest[kRadialP];
    w[kRadialQ] =
        -beta2 + k * beta1 + (1 - 2 * k) * (d0 - (1 + lam1 - n) * c.p[n]) + d0 * rest[kRadialQ];
    w[kRadialS] = 3 * (beta2 - k * beta1) + 2 * (gamma2 - k * gamma1) + d0 * rest[kRadialS];
    w[kRadialF] = s.h[n] - k * c.h[n];
    w[kRadialM1] = s.h[n];
    w[kRadialM0] = s.m0[n];
    w[kRadialC0] = k * c.m0[n];
  }
  return weights;
}

}  // namespace bem
