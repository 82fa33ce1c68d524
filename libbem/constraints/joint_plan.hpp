#pragma once

#include "constraints/joints.hpp"

namespace bem {

/// What a weld joins.
struct WeldPlan {
  const JointSpec* spec = nullptr;
  std::size_t joined = 0;  ///< pairs of vertices
  /// Vertices of either body that have no partner within the tolerance, but one within a tenth of
  /// the shortest edge around them; and the largest of these distances [m].
  std::size_t nearly = 0;
  double farthest = 0;
  std::size_t alone = 0;  ///< vertices on the other body's surface where it has no vertex
};

/// All joints of a scene, and the nodes that they act on: by body, ascending.
struct JointPlan {
  std::vector<Joint> joints;
  std::vector<WeldPlan> welds;
  std::vector<std::vector<JointNode>> nodes;
};

/// "12 vertices miss a partner by up to 0.001 m".
std::string nearly_text(const WeldPlan& weld);

/// Fixed vertices, handles, point joints and welds. `geometries`: by body. Throws
/// ErrorCode::invalid_input, naming the place in the scene, for contradictory selections, points
/// away from the surface, and welds without common vertices. The plan refers to the scene.
JointPlan plan_joints(const Scene& scene, const std::vector<const BodyGeometry*>& geometries);

}  // namespace bem
