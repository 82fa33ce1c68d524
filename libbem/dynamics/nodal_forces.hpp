#pragma once

#include "base/types.hpp"

namespace bem {

/// The nodes of a body that constraints act on: those of joints, and those in contact.
enum class NodeGroup { joint, contact };

/// Forces on single nodes of a body during a step, in its axes.
struct NodalForces {
  Eigen::MatrixXd joint;    ///< on the joint nodes, 3 per node, stage by stage [N]
  Eigen::VectorXd contact;  ///< on the contact nodes, constant over the step [N]
};

}  // namespace bem
