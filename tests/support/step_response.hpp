#pragma once

#include "kernels/contour.hpp"

namespace bem_test {

/// Values u_0..u_steps that convolution quadrature gives for a scalar transfer function under a
/// unit load that sets in at t = 0: u_n is the last stage of sum_k X_k p_{n-k}, with p = 1 at all
/// stages of the steps 1, 2, ... and p_0 = `initial_load`, which only multistep methods have. A
/// simulation starts from a given state and leaves p_0 out.
inline std::vector<double> step_response(const bem::Scheme& scheme, double dt, int steps,
                                         const std::function<bem::Complex(bem::Complex)>& transfer,
                                         double initial_load = 0) {
  const bem::ContourQuadrature contour(scheme, steps);
  const bem::LaneLayout& lanes = contour.layout();
  std::vector<double> weights(lanes.count());
  contour.weights(
      1, [&](bem::Complex d, bem::Complex* value) { *value = transfer(d / dt); }, weights.data());
  const std::vector<double> factors = bem::static_lane_factors(scheme, lanes);
  std::vector<double> u;
  double sum = 0;
  for (int n = 0, lane = 0; n <= steps; ++n) {
    double weight = 0;
    for (const int end = lanes.lane(n + 1, 0); lane < end; ++lane)
      weight += factors[lane] * weights[lane];
    u.push_back(sum + initial_load * weight);
    sum += weight;
  }
  return u;
}

}  // namespace bem_test
