#pragma once

#include "mesh/triangle_mesh.hpp"
#include "output/trajectory_file.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace bem {

/// A trajectory.h5 of a scene, frame by frame.
class Trajectory {
 public:
  /// Throws ErrorCode::archive if the file is not a trajectory of the scene's bodies, or has
  /// nothing but the render mesh of one.
  Trajectory(const std::string& path, const Scene& scene);

  const std::vector<double>& times() const { return file_.times(); }  ///< [s]
  /// Body b in frame k, world coordinates.
  TriangleMesh body(std::size_t b, std::size_t k) const;
  const TrajectoryFile& file() const { return file_; }
  /// Of the simulated surfaces in the file.
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::string simulated(const std::string& body) const;

  TrajectoryFile file_;
  std::vector<std::string> names_;
  std::vector<std::vector<Triangle>> triangles_;
};

}  // namespace bem
