#pragma once

#include "model/elastic_system.hpp"

namespace bem {

struct GrowthEstimate {
  double factor = 0;     ///< largest growth factor per step of a free, unloaded body
  double frequency = 0;  ///< of the motion that grows so [periods per step]
  double residual = 0;   ///< of the eigenvalue it comes from
  int steps = 0;         ///< steps of the recursion that were taken
};

/// Largest growth factor per step of the free recursion with removal of rigid motion: the spectral
/// radius of the step operator, by Krylov-Schur iteration from a smoothed random state. Values
/// above 1 mean that the discretisation blows up; a window factor q multiplies the result by
/// exactly q. The model's own window is left out of account. Cost: 40 to 650 steps, more the
/// shorter the time steps are.
GrowthEstimate growth_factor(const BodyModel& model);

/// Retardation time [time steps] of the Kelvin-Voigt damping that takes from a motion what it
/// gains, w^2 T/2 = log(growth); growth per step, frequency > 0 [periods per step].
double holding_damping(double growth, double frequency);

}  // namespace bem
