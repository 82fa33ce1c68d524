#pragma once

#include "kernels/radial_functions.hpp"

#include <vector>

namespace bem {

/// Convolution quadrature weights of BDF1 in closed form: Poisson probabilities and their tails.
/// lam = r/(c dt).
struct PoissonWeights {
  std::vector<double> p;   ///< of exp(-s r/c)    (M20)
  std::vector<double> h;   ///< of M_1(s r/c)
  std::vector<double> m0;  ///< of M_0(s r/c)
};

/// Weights for lags 0..last_lag, by recurrences of positive terms only (M23); 0 <= lam < 700.
PoissonWeights poisson_weights(double lam, int last_lag);

/// BDF1 weights of all radial functions at lam = r/(c2 dt), lags 0..last_lag; the static parts of
/// P, Q, S belong to lag 0  (M21), (M22).
std::vector<RadialValues<double>> bdf1_radial_weights(double lam, double kappa, int last_lag);

}  // namespace bem
