#pragma once

#include "base/types.hpp"
#include "mesh/rigid_place.hpp"
#include "output/trajectory_contents.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace bem {

/// One body at one time.
struct BodyFrame {
  std::vector<Vec3> positions;  ///< by vertex of the body's mesh [m, world]
  RigidPlace frame;             ///< of the body: world = frame of frame coordinates
  std::vector<std::vector<double>> fields = {};  ///< by field of the body: a vertex after another
  std::vector<double> series = {};               ///< the body's series, one after another
  std::vector<Vec3> normals = {};  ///< unit vectors, by normal of a render mesh's ObjTemplate
};

/// Where two surfaces touch.
struct ContactFrame {
  Vec3 point;                  ///< [m]
  Vec3 normal;                 ///< unit vector out of the second surface
  Vec3 force;                  ///< on the first surface, the mean over the last step [N]
  std::array<int, 2> surface;  ///< bodies by their order in the scene, then obstacles
};

/// All bodies at one time.
struct Frame {
  std::size_t index = 0;          ///< 0, 1, 2, ...; 0 is the initial state
  std::size_t step = 0;           ///< of the simulation
  double time = 0;                ///< [s]
  std::vector<BodyFrame> bodies;  ///< in the order of TrajectoryContents, as are
  std::vector<RigidPlace> obstacles = {};
  std::vector<ContactFrame> contacts = {};  ///< unused without the flag of TrajectoryContents
};

/// Checks that a frame has the sizes of the contents; throws ErrorCode::internal.
void check_frame(const TrajectoryContents& contents, const Frame& frame);

}  // namespace bem
