#pragma once

#include "output/frame.hpp"
#include "plan.hpp"
#include "simulation/simulation.hpp"

#include <vector>

namespace bem {

/// What the trajectories of a plan hold: for each body the surface that is simulated, its render
/// mesh, or first this and then that.
std::vector<TrajectoryBody> trajectory_bodies(const Plan& plan);

/// The same bodies as they are now. Throws ErrorCode::numerical if a number is not finite.
std::vector<BodyFrame> body_frames(const Plan& plan, const Simulation& simulation);

}  // namespace bem
