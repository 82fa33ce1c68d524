#pragma once

#include "base/types.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// What stays the same in all frames of a trajectory.

namespace bem {

struct RenderMesh;

/// What a body of a trajectory is of.
enum class TrajectorySurface {
  only,       ///< the simulated surface, which is the one that there is
  render,     ///< a mesh that is bound to the simulated surface
  simulation  ///< the simulated surface of a body that has a render mesh
};

/// Numbers that every frame has, at each vertex of a body or for all of it.
struct FrameQuantity {
  std::string name;            ///< in files
  std::string units;           ///< "1" without
  std::size_t components = 1;  ///< 1; 3: a vector; 6: a symmetric tensor xx yy zz xy yz xz
};

struct TrajectoryBody {
  std::string name;                 ///< unique; fit to be part of a file name and of an HDF5 path
  std::size_t vertices = 0;         ///< of the input mesh, or of the render mesh
  std::vector<Triangle> triangles;  ///< of this mesh, as it lists them
  std::vector<FrameQuantity> fields = {};  ///< at its vertices, beside positions; world axes
  std::vector<Vec3> rest = {};             ///< vertices of this mesh [m]; some formats need them
  TrajectorySurface surface = TrajectorySurface::only;
  std::shared_ptr<const RenderMesh> render = nullptr;  ///< for TrajectorySurface::render
  std::vector<FrameQuantity> series = {};              ///< of all of the body
  std::size_t index = 0;                               ///< in the scene
  double mass = 0;                                     ///< [kg]
  std::string archive_digest = {}, mesh_digest = {};   ///< hexadecimal; empty if not known
};

struct ObstaclePlane {
  Vec3 point;   ///< [m]
  Vec3 normal;  ///< unit vector out of the obstacle
};

struct TrajectoryObstacle {
  std::string name;                    ///< unique among bodies and obstacles
  std::optional<ObstaclePlane> plane;  ///< or
  std::vector<Vec3> vertices = {};     ///< of a mesh, after its scale [m]
  std::vector<Triangle> triangles = {};
  std::size_t index = 0;  ///< in the scene, after its bodies
};

struct TrajectoryContents {
  // Implicit: a trajectory of some bodies.
  TrajectoryContents(std::vector<TrajectoryBody> of = {}) : bodies(std::move(of)) {}

  std::vector<TrajectoryBody> bodies;
  std::vector<TrajectoryObstacle> obstacles;
  bool contacts = false;  ///< frames bring contacts that are to be written
  std::string program;    ///< name and version of what makes it; empty if not known
  std::string scene;      ///< text of the scene file; likewise
  double time_step = 0;   ///< of the simulation [s]; likewise
};

/// Checks names, triangles and vertices; throws ErrorCode::internal.
void check_contents(const TrajectoryContents& contents);

/// Checks that the bodies bring the vertices of their meshes; throws ErrorCode::internal.
void check_rest(const std::vector<TrajectoryBody>& bodies);

}  // namespace bem
