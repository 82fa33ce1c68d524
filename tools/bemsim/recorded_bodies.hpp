#pragma once

#include "plan.hpp"
#include "recording/recorder.hpp"

#include <memory>

namespace bem {

/// What makes the frames of a plan's trajectories; refers to the plan.
std::unique_ptr<Recorder> make_recorder(const Plan& plan);

}  // namespace bem
