#pragma once

#include "collision/collision_detector.hpp"
#include "constraints/contact_tolerances.hpp"
#include "constraints/placed_contacts.hpp"
#include "mesh/obstacle_surface.hpp"

namespace bem {

/// A rigid surface of the scene, in the (scaled) coordinates of its mesh.
struct ObstacleMesh {
  const ObstacleSpec* spec = nullptr;
  ObstacleSurface surface;
};

/// The bodies and obstacles of a scene as surfaces that can touch. Finds the contacts of a step.
class CollisionScene {
 public:
  /// Contact is left out between bodies of `joined_bodies`. The scene and the bodies must outlive
  /// this.
  CollisionScene(const Scene& scene, const std::vector<Body>& bodies,
                 const std::vector<ObstacleMesh>& obstacles,
                 const std::vector<std::pair<int, int>>& joined_bodies,
                 const ContactTolerances& tolerances);

  /// Bodies and obstacles that are in each other where the bodies are now.
  struct Overlap {
    std::string a, b;  ///< names
    double depth = 0;  ///< [m]
  };
  std::vector<Overlap> overlaps();

  /// Takes the positions at the start of the step from t to t + dt [s]. `broken`: the contacts that
  /// the step before has left broken. However deep their sides are in each other, they stay.
  void begin_step(double t, double dt, const std::vector<ContactKey>& broken = {});
  /// Contacts if the bodies stayed where they are while obstacles move.
  std::vector<ContactPair> detect_at_rest();
  /// Contacts for the bodies' predicted positions at its end.
  std::vector<ContactPair> detect(std::vector<Body>& bodies);

 private:
  std::vector<ContactPair> detect();
  ContactPair pair_of(const Contact& contact) const;
  void find_pressed(const std::vector<ContactKey>& broken);
  double depth(const ContactKey& key) const;
  CollisionDetector make_detector(const std::vector<std::pair<int, int>>& joined_bodies) const;
  const std::vector<Triangle>& triangles(std::size_t surface) const;
  const std::string& name(std::size_t surface) const;
  std::vector<int> places_in_scene() const;

  /// The solid parts of an obstacle, or its sheets: surfaces of their own.
  struct ObstaclePart {
    const ObstacleSpec* spec = nullptr;
    TriangleMesh mesh;
    std::vector<Triangle> rim;  ///< of a sheet, with the mesh's vertices
    double recovery_depth = std::numeric_limits<double>::infinity();  ///< see CollisionSurface
  };
  static std::vector<ObstaclePart> parts_of(const std::vector<ObstacleMesh>& obstacles,
                                            double sheet_offset);

  const Scene& scene_;
  const std::vector<Body>& bodies_;
  ContactTolerances tolerances_;
  std::vector<ObstaclePart> obstacles_;
  std::vector<double> friction_;                ///< by surface: bodies, parts of obstacles, planes
  std::vector<int> in_scene_;                   ///< likewise: body, or obstacle after them
  std::vector<std::vector<Vec3>> start_, end_;  ///< by surface
  std::vector<ContactKey> pressed_;  ///< broken ones that are deeper than what detection looks for
  double deepest_ = 0;               ///< of them [m]
  CollisionDetector detector_;
};

}  // namespace bem
