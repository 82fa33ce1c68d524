#pragma once

#include "dynamics/body.hpp"
#include "scene/scene.hpp"

namespace bem {

/// Shares that decide what a scene means by its joints. They compare lengths of the scene with
/// those of its meshes and have nothing to do with the tolerance to which contacts are met.
struct JointTolerances {
  /// Of a body's extent: a point of a joint may be so far from the body's surface.
  static constexpr double off_surface = 0.01;
  /// Of the shortest edge around a vertex that a weld leaves alone: a vertex of the other body that
  /// is so near was probably meant to be its partner.
  static constexpr double nearly = 0.1;
  /// Of the same edge: so near to the other body's surface the vertex lies on it.
  static constexpr double on_surface = 1e-3;
  /// Width over length of a set of points below which they are on one line.
  static constexpr double thin = 1e-3;
  /// Of a handle's release time: a step that ends so much later is held, for rounding's sake.
  static constexpr double release = 1e-9;
};

/// A point of a body's surface: weights over up to three nodes.
struct Attachment {
  int body = -1;  ///< -1: a place in the world
  int count = 0;
  std::array<int, 3> nodes = {-1, -1, -1};
  std::array<double, 3> weights = {0, 0, 0};

  /// Where it is if the body's nodes are here [m].
  Vec3 place(const std::vector<Vec3>& of_nodes) const;
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

}  // namespace bem
