#pragma once

#include "constraints/constraint_solver.hpp"

namespace bem {

/// Joints of bodies that start elsewhere than the scene places them.
///
/// Makes what holds a body in the world hold it where it is now, unless all of that is where the
/// scene says to rounding.
void hold_in_place(JointPlan& plan, std::vector<Body>& bodies, std::size_t body,
                   ConstraintSolver& solver);

/// Throws ErrorCode::invalid_input if a joint connects points of bodies that are apart now: it
/// would pull them together within a step.
void check_joined(const JointPlan& plan, const std::vector<Body>& bodies);

}  // namespace bem
