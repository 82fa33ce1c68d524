#pragma once

#include "handover/animated_scene.hpp"
#include "output/trajectory_file.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bem {

struct RenderMesh;

/// What other programs get of a trajectory.
struct AnimationChoice {
  std::vector<std::string> bodies;
  std::vector<std::size_t> frames;  ///< of the file, at least one
  /// Datasets of values at vertices; all that a body has without.
  std::optional<std::vector<std::string>> fields = {};
  /// Faces and texture coordinates of bodies; the others have the file's triangles.
  std::map<std::string, std::shared_ptr<const RenderMesh>> meshes = {};
};

/// The scene of a trajectory, which reads from the file when it is asked and must not outlive it.
/// A plane becomes a square below all of the motion. Throws Error with the file's code.
AnimatedScene animated_scene(const TrajectoryFile& file, const AnimationChoice& choice);

}  // namespace bem
