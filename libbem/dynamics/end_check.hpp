#pragma once

#include "dynamics/deformation_watch.hpp"
#include "dynamics/rigid_frame.hpp"
#include "model/body_model.hpp"

#include <string>

namespace bem {

// Motions that have no meaning any more stop a run. `name` is the body's, `time` the end of the
// step [s]; both functions throw ErrorCode::numerical.

/// Throws if the end of a step is not finite, or displacements [m] are more than a hundred times
/// the body's extent.
void check_end(const std::string& name, const BodyModel& model, const RigidFrame::Stages& frame,
               const Eigen::VectorXd& displacement, double time);
/// Throws if the body is inside out.
void check_inversion(const std::string& name, const BodyModel& model,
                     const DeformationWatch& deformation, double time);

}  // namespace bem
