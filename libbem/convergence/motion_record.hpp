#pragma once

#include "render/surface_binding.hpp"
#include "simulation/simulation.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bem {

/// Vertices of a body's mesh file, which all runs of a study follow whatever mesh they simulate.
struct FollowedPoints {
  std::shared_ptr<const TriangleMesh> mesh;  ///< of the file, times its scale [m]
  std::vector<int> vertices;                 ///< those that are followed
  std::vector<Vec3> rest;                    ///< where they are in the mesh [m]
  std::vector<double> weights;               ///< parts of the surface that they stand for, sum 1
};

/// Chooses at most `most` vertices, evenly by their numbers. Throws ErrorCode::invalid_input if
/// the file cannot be read.
FollowedPoints follow_points(const std::string& mesh_path, double mesh_scale, std::size_t most);

/// Those of all bodies of a scene; bodies with the same mesh share them. About 2000 in all.
std::vector<std::shared_ptr<const FollowedPoints>> followed_points(const Scene& scene);

/// Where the points of a body have been, three numbers per point and time [m] in vectors whose
/// scalar products are means over surface and times: number times sqrt(weight / times).
struct BodyMotion {
  std::vector<double> position;  ///< in the world
  std::vector<double> rigid;     ///< where the nearest rigid motion (fit_rigid_motion) brings them
  std::vector<double> deformation;  ///< the rest of it, in axes that turn with the rigid motion
  std::vector<double> path;         ///< the way from the place at the start
};

/// Records the motion of the bodies of a simulation.
class MotionRecorder {
 public:
  /// Binds the points to the bodies' surfaces. `times`: how often record() will be called.
  MotionRecorder(std::vector<std::shared_ptr<const FollowedPoints>> points,
                 const Simulation& simulation, std::size_t times);

  void record(const Simulation& simulation);
  std::vector<BodyMotion> take() { return std::move(motions_); }  ///< by body

 private:
  void record(std::size_t body, const std::vector<Vec3>& positions);

  std::vector<std::shared_ptr<const FollowedPoints>> points_;
  std::vector<std::shared_ptr<const SurfaceBinding>> bindings_;
  std::vector<std::vector<Vec3>> start_;
  std::vector<BodyMotion> motions_;
  double times_;
};

}  // namespace bem
