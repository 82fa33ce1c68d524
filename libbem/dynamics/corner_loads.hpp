#pragma once

#include "dynamics/joint_node.hpp"
#include "dynamics/load_shape.hpp"
#include "model/elastic_system.hpp"

#include <memory>

namespace bem {

/// Tractions of joint nodes at sharp edges, where they act on some of the triangles around the node
/// only: the hat functions of double nodes, whose displacements are the same as the node's and need
/// no unknowns of their own (docs/method.md, "Double nodes").
struct CornerLoads {
  std::vector<int> shape_of_joint;  ///< by joint node: which shape, or -1
  std::vector<double> areas;        ///< integral of a shape's hat function over its triangles [m^2]
  LoadShape shape;                  ///< of the inputs
  InputColumns columns;             ///< three inputs per shape: its tractions along the axes [Pa]

  Eigen::Index inputs() const { return static_cast<Eigen::Index>(3 * areas.size()); }
  /// The first input of a joint node, or -1.
  Eigen::Index input_of(std::size_t joint) const {
    return shape_of_joint[joint] < 0 ? -1 : 3 * shape_of_joint[joint];
  }
};

/// Null if no node has triangles of its own.
std::shared_ptr<const CornerLoads> make_corner_loads(const ElasticSystem& system,
                                                     const LoadAssembler& assembler,
                                                     const std::vector<JointNode>& nodes);

/// Whether bodies with these joint nodes need make_corner_loads().
bool has_corner_loads(const std::vector<JointNode>& nodes);

}  // namespace bem
