#pragma once

#include "base/material.hpp"
#include "mesh/body_geometry.hpp"

#include <optional>
#include <vector>

namespace bem {

/// What the choice of a time step looks at, of one deformable body.
struct WaveTimes {
  double edge = 0;    ///< time that a shear wave takes along an edge of median length [s]
  double extent = 0;  ///< and across the body [s]
};
WaveTimes wave_times(const TriangleMesh& mesh, double extent, const Material& material);

/// A time step for these bodies: the time that a shear wave takes along an edge of the body with
/// the shortest such time, at most an eighth of what it takes across the body (an impact lasts for
/// about twice that time), and at most a fiftieth of a second. No body gets a history that is
/// expensive: the step is at least a thirtieth of the longest time across a body, also where
/// stiffer bodies would need a shorter one. The step is rounded down to one or two digits; where
/// frames are written every `frame_interval` [s], to a whole part of that. No bodies: a hundredth
/// of a second.
double automatic_time_step(const std::vector<WaveTimes>& bodies,
                           std::optional<double> frame_interval = std::nullopt);

}  // namespace bem
