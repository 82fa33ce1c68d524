#pragma once

#include "base/types.hpp"
#include "output/trajectory_file.hpp"

#include <string>
#include <vector>

namespace bem {

/// An obstacle as a trajectory of layout 2 has it: a plane, or a mesh with a pose in every frame.
struct RecordedObstacle {
  std::string name;
  bool is_plane = false;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitY();  ///< of a plane [m, 1]
  std::vector<double> vertices;                       ///< of a mesh, [N x 3], in its own axes [m]
  std::vector<Triangle> triangles;                    ///< of a mesh
  std::vector<double> translations;  ///< [frames x 3]: a vertex x is at translation + rotation x
  std::vector<double> rotations;     ///< [frames x 3 x 3]
};

/// All obstacles of a trajectory, in the order of the scene; none in layout 1. Throws Error with
/// the file's code.
std::vector<RecordedObstacle> read_obstacles(const TrajectoryFile& file);

/// Contacts of all frames: rows `ends[k-1]` to before `ends[k]` belong to frame k.
struct RecordedContacts {
  std::vector<std::size_t> ends;  ///< contact_ends()
  std::vector<double> points;     ///< [rows x 3, m]
  std::vector<double> forces;     ///< on the first surface [rows x 3, N]
};

/// Rows of contacts up to the end of every frame; empty if the trajectory has no contacts. Throws
/// Error with the file's code.
std::vector<std::size_t> contact_ends(const TrajectoryFile& file);

/// The contacts of a trajectory with the field `contacts`. Throws Error with the file's code.
RecordedContacts read_contacts(const TrajectoryFile& file);

/// Unit vector against the gravity of a scene's text; the y axis if there is none.
Vec3 up_of_scene(const std::string& text);

}  // namespace bem
