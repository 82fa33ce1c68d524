#pragma once

#include "constraints/joint_plan.hpp"
#include "mesh/obstacle_surface.hpp"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace bem {

/// Loads what a scene needs of its files.
class ModelSource {
 public:
  virtual ~ModelSource() = default;
  /// The model with the matrices of free motion, for an archive path as resolved in the scene.
  virtual std::shared_ptr<const BodyModel> model(const FilePath& archive) = 0;
  /// Traction columns of some nodes, ascending.
  virtual TractionData tractions(const FilePath& archive, const std::vector<int>& nodes) = 0;
  /// Digest of an archive; empty for a model that was never in a file.
  virtual std::string digest(const FilePath& /*archive*/) { return ""; }
  /// The surface of an obstacle in its mesh's coordinates times its scale, made once for every mesh
  /// and scale. Throws ErrorCode::invalid_input if the mesh is no surface.
  const ObstacleSurface& obstacle(const MeshObstacle& obstacle);

 private:
  /// The mesh of an obstacle as it is in its file.
  virtual TriangleMesh obstacle_mesh(const FilePath& mesh) = 0;

  std::map<std::pair<std::string, std::array<double, 3>>, ObstacleSurface> obstacles_;
};

class InitialState;

/// The bodies of a scene at its start, and what connects them.
struct LoadedScene {
  JointPlan plan;  ///< refers to the scene
  std::vector<Body> bodies;
  std::vector<std::string> digests;       ///< of their archives
  std::vector<std::vector<int>> sharing;  ///< deformable bodies by archive
  std::size_t matrix_bytes = 0;           ///< of the matrices in memory
  std::size_t archives = 0;               ///< that they come from
};

/// Loads every archive once, and puts bodies where the scene places them
/// (simulation/placement.hpp); `initial`, which may be null, is checked and gets what it needs of
/// archives, but is not applied. The scene must outlive what is returned. Throws
/// ErrorCode::archive, naming the place in the scene, if an archive does not fit it, and as
/// InitialState::check().
LoadedScene load_scene(Scene& scene, ModelSource& source, const InitialState* initial = nullptr);

/// Throws ErrorCode::archive, naming the place in the scene, if the archive of a body was made for
/// another time step than the scene's, or for another correction than the body's.
void check_archive(const Scene& scene, const BodySpec& body, ModelKind kind,
                   const Discretisation& discretisation);

/// The time discretisations of a scene's bodies in their order, from those of the deformable ones;
/// rigid bodies (null) take that of the first. Throws ErrorCode::archive, naming the place in the
/// scene, if a joint connects bodies with different ones.
std::vector<Scheme> body_schemes(const Scene& scene,
                                 const std::vector<const Discretisation*>& deformable);

}  // namespace bem
