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

  /// Bodies and obstacles that are in each other where the bodies are now.
  struct Overlap {
    std::string a, b;  ///< names
    double depth = 0;  ///< [m]
  };
  std::vector<Overlap> overlaps();

  /// Takes the positions at the start of the step from t to t + dt [s].
  void begin_step(double t, double dt);
  /// Contacts if the bodies stayed where they are while obstacles move.
  std::vector<ContactPair> detect_at_rest();
  /// Contacts for the bodies' predicted positions at its end.
  std::vector<ContactPair> detect(std::vector<Body>& bodies);

  /// Size of the smallest body [m].
  double smallest() const { return smallest_; }

 private:
  std::vector<ContactPair> detect();
  ContactPair pair_of(const Contact& contact) const;

  std::vector<Triangle> triangles(std::size_t surface) const;

  const Scene& scene_;
  const std::vector<Body>& bodies_;
  std::vector<ObstacleMesh> obstacles_;
  double smallest_ = std::numeric_limits<double>::infinity();
  std::vector<double> friction_;                ///< by surface: bodies, mesh obstacles, planes
  std::vector<std::vector<Vec3>> start_, end_;  ///< by surface
  CollisionDetector detector_;
};

}  // namespace bem
