#pragma once

#include "base/state_archive.hpp"

namespace bem {

/// What acted on bodies from outside, as impulses [N s]: forces by the quadrature of the time
/// discretisation. Forces between bodies are not among them.
struct Impulses {
  Vec3 gravity = Vec3::Zero();
  Vec3 loads = Vec3::Zero();      ///< prescribed tractions
  Vec3 window = Vec3::Zero();     ///< the window on the rigid motion of held bodies
  Vec3 joints = Vec3::Zero();     ///< fixed vertices, handles, joints to the world
  Vec3 obstacles = Vec3::Zero();  ///< contacts with obstacles

  Impulses& operator+=(const Impulses& other) {
    gravity += other.gravity;
    loads += other.loads;
    window += other.window;
    joints += other.joints;
    obstacles += other.obstacles;
    return *this;
  }
  void visit_state(StateArchive& state) { state(gravity, loads, window, joints, obstacles); }
  Vec3 total() const { return gravity + loads + window + joints + obstacles; }
  double sum_of_norms() const {
    return gravity.norm() + loads.norm() + window.norm() + joints.norm() + obstacles.norm();
  }
};

}  // namespace bem
