#pragma once

#include "contact/collision_detector.hpp"
#include "contact/constraint_solver.hpp"

namespace bem {

/// A rigid closed or open surface of the scene, read from its file.
struct ObstacleMesh {
  const ObstacleSpec* spec = nullptr;
  TriangleMesh mesh;
};

/// The bodies and obstacles of a scene as surfaces that can touch. Finds the contacts of a step.
class CollisionScene {
 public:
  /// Contact is left out between bodies of `joined_bodies`. The scene and the bodies must outlive
  /// this.
  CollisionScene(const Scene& scene, const std::vector<Body>& bodies,
                 std::vector<ObstacleMesh> obstacles,
                 const std::vector<std::pair<int, int>>& joined_bodies);

  /// Takes the positions at the start of the step from t to t + dt [s].
  void begin_step(double t, double dt);
  /// Contacts for the bodies' predicted positions at its end.
  std::vector<ContactPair> detect(std::vector<Body>& bodies);

 private:
  ContactPair pair_of(const Contact& contact) const;

  const Scene& scene_;
  const std::vector<Body>& bodies_;
  std::vector<ObstacleMesh> obstacles_;
  std::vector<double> friction_;                ///< by surface: bodies, mesh obstacles, planes
  std::vector<std::vector<Vec3>> start_, end_;  ///< by surface
  CollisionDetector detector_;
};

}  // namespace bem
