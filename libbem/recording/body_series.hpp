#pragma once

#include "dynamics/body.hpp"
#include "output/trajectory_contents.hpp"

#include <vector>

namespace bem {

/// What trajectories hold of a body as a whole (docs/trajectory-format.md, "Series"). `energies`:
/// whether they are known (BodyOutput::has_energies()).
std::vector<FrameQuantity> body_series(bool energies);

/// Their values after the last step, one after another.
std::vector<double> series_values(const Body& body, const Vec3& contact_force,
                                  const Vec3& contact_torque);

}  // namespace bem
