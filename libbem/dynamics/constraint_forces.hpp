#pragma once

#include "base/types.hpp"

namespace bem {

/// What constraints exert on a body in a step.
struct ConstraintForces {
  /// On the joint nodes, in the axes of the body: 3 per node x stages [N].
  Eigen::MatrixXd joint;
  /// On the contact nodes, in world axes and constant over the step: 3 per node [N].
  Eigen::VectorXd contact;
  /// Moment of the contact forces about where the centre of mass is at the start of the step, in
  /// world axes [N m]. It is given apart from them because both bodies of a contact must take the
  /// same point of action, or angular momentum would be lost.
  Vec3 contact_moment = Vec3::Zero();
};

}  // namespace bem
