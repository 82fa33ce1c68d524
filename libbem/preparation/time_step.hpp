#pragma once

#include "base/material.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// The time that a shear wave takes across a deformable body [s].
double crossing_time(double extent, const Material& material);

struct AutomaticTimeStep {
  double seconds = 0;
  std::string reason;  ///< goes on after the time: ", the longest that is chosen by itself"
};

/// A time step for bodies with these crossing times: an eighth of the shortest one. (An impact
/// lasts for about two crossings, the slowest vibration of a compact body for a little more than
/// one; the cost of matrices grows with the number of steps in a crossing.) No body is crossed in
/// more than thirty steps, also where stiffer bodies would need a shorter step. The step is at most
/// a fiftieth of a second and is rounded down to one or two digits; where frames are written every
/// `frame_interval` [s], to a whole part of that. No bodies: a hundredth of a second.
AutomaticTimeStep automatic_time_step(const std::vector<double>& crossings,
                                      std::optional<double> frame_interval = std::nullopt);

}  // namespace bem
