#pragma once

#include "dynamics/body.hpp"
#include "scene/scene.hpp"

namespace bem {

/// A point of a body's surface: weights over up to three nodes.
struct Attachment {
  int body = -1;  ///< -1: a place in the world
  int count = 0;
  std::array<int, 3> nodes = {-1, -1, -1};
  std::array<double, 3> weights = {0, 0, 0};
};

/// Two points that stay together at every stage, or a point that goes where the scene says.
struct Joint {
  Attachment a, b;
  bool prescribed = false;             ///< a fixed vertex, or one of a handle
  const HandleSpec* handle = nullptr;  ///< of a; null for what is fixed or joined
  Vec3 place = Vec3::Zero();           ///< without b: where a starts in the world [m]
  Vec3 offset = Vec3::Zero();          ///< with b: b - a at the start, in the axes of a's body [m]

  bool to_world() const { return b.body < 0; }
  /// Whether it holds in a step that ends at `t` [s].
  bool is_active(double t) const;
  /// World place of a at time t, for joints to the world.
  Vec3 target(double t) const;
};

/// The rigid motion of what holds a body, from the places of its prescribed nodes in a step from t
/// over dt; nothing if they are on one line and leave the body a rigid motion. `centre`: where its
/// centre of mass starts.
std::optional<Holder> holder_motion(const std::vector<const Joint*>& prescribed, const Vec3& centre,
                                    double t, double dt, const StageVector& stage_times);

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
