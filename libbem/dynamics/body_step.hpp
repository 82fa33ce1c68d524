#pragma once

#include "dynamics/constraint_forces.hpp"
#include "dynamics/elastic_part.hpp"
#include "dynamics/rigid_frame.hpp"

namespace bem {

/// The current step of a body as Body::update() has computed it.
struct BodyStep {
  std::vector<int> contact_nodes;
  ConstraintForces forces;
  FrameDrag drag;
  RigidFrame::Stages frame;          ///< at the stages
  std::vector<Mat3> force_rotation;  ///< by stage: has given directions in body axes to forces
  ElasticPart::Displacements displacements;  ///< of the constraint nodes; deformable bodies only

  /// The forces on constraint nodes in body axes.
  NodalForces nodal_forces() const;
  /// Sum of the contact forces, world axes [N].
  Vec3 contact_force() const;
};

}  // namespace bem
