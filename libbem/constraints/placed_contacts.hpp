#pragma once

#include "collision/contact.hpp"
#include "constraints/port.hpp"
#include "dynamics/body.hpp"

namespace bem {

/// A contact of the current step between surfaces; the surface of an obstacle has no body.
struct ContactPair {
  Contact contact;
  int body_a = -1, body_b = -1;          ///< -1: an obstacle
  int in_scene_a = -1, in_scene_b = -1;  ///< bodies by their order in the scene, then obstacles
  Vec3 obstacle_a = Vec3::Zero();  ///< place of a point of an obstacle at the end of the step [m]
  Vec3 obstacle_b = Vec3::Zero();
  double friction = 0;
};

/// Contacts with their frames, and where they touch the bodies.
struct PlacedContacts {
  std::vector<ContactPair> pairs;
  std::vector<Mat3> frames;              ///< columns: normal and two tangents
  std::vector<std::vector<Port>> ports;  ///< by body; slots are places in its contact nodes

  /// World vectors, one per contact, in the frames of the contacts: 3 per contact.
  Eigen::VectorXd to_frames(const std::vector<Vec3>& vectors) const;
  /// The opposite, for the change of one contact.
  Vec3 to_world(const Eigen::VectorXd& local, std::size_t contact) const {
    return frames[contact] * local.segment<3>(static_cast<Eigen::Index>(3 * contact));
  }
  /// Gap and slip of the contacts at the end of the step for the bodies as updated, in the frames
  /// of the contacts: 3 per contact [m].
  Eigen::VectorXd displacements(const std::vector<Body>& bodies) const;
  /// Adds the world forces on the sides a of the contacts, and the opposite ones on the sides b, to
  /// those of all bodies [N].
  void add_forces(const std::vector<Vec3>& forces, const std::vector<Body>& bodies,
                  std::vector<ConstraintForces>& by_body) const;
};

/// Tells the bodies which of their nodes are in contact; their contact forces are zero after it.
PlacedContacts place_contacts(const std::vector<ContactPair>& pairs, std::vector<Body>& bodies);

}  // namespace bem
