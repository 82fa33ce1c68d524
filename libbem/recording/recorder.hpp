#pragma once

#include "dynamics/surface_stress.hpp"
#include "mesh/obstacle_surface.hpp"
#include "output/frame.hpp"
#include "render/bound_mesh.hpp"
#include "simulation/simulation.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bem {

/// A body of a scene and what is shown of it.
struct ShownBody {
  const BodySpec* spec;
  const BodyGeometry* geometry;
  const Material* material;
  std::string archive_digest = {};                    ///< empty if not known
  std::shared_ptr<const BoundMesh> render = nullptr;  ///< a mesh to show in place of the surface
  /// The render mesh is the simulated surface, with faces and texture coordinates as in its file.
  bool shows_surface = false;
  bool energies = false;  ///< whether they are known, as BodyOutput::has_energies()
};

/// An obstacle; a plane has no surface.
struct ShownObstacle {
  const ObstacleSpec* spec;
  const ObstacleSurface* surface;
};

/// The contacts of the last step where its end has brought them.
std::vector<ContactFrame> contact_frames(const Simulation& simulation);

/// The frame of a body: without displacements a vertex with mesh coordinates x is at translation +
/// rotation * x.
RigidPlace place_of(const BodySpec& spec, const Body& body);

/// The values of body_series() of a body, `index` in the scene.
std::vector<double> body_series_of(const Body& body, int index,
                                   const std::vector<ContactFrame>& contacts);

/// Makes the frames of a trajectory of a simulation: what the scene's "output" asks for.
class Recorder {
 public:
  /// All that is pointed to must outlive this. `program`: name and version for the file.
  Recorder(const Scene& scene, std::vector<ShownBody> bodies,
           const std::vector<ShownObstacle>& obstacles, std::string program);

  /// For each body the simulated surface, its render mesh, or first this and then that; then the
  /// obstacles.
  const TrajectoryContents& contents() const { return contents_; }

  /// The simulation as it is now. Throws ErrorCode::numerical if a number is not finite.
  Frame frame(const Simulation& simulation, std::size_t index) const;

 private:
  bool writes(OutputField field) const;
  bool writes_simulated_surface(const ShownBody& body) const;
  void add_body(const ShownBody& body, std::size_t index);
  std::vector<Eigen::MatrixXd> node_fields(std::size_t index, const Body& body) const;
  BodyFrame surface_frame(const Body& body, const std::vector<Eigen::MatrixXd>& fields) const;
  BodyFrame render_frame(const BoundMesh& mesh, const Body& body,
                         const std::vector<Eigen::MatrixXd>& fields) const;

  const Scene& scene_;
  std::vector<ShownBody> bodies_;
  std::vector<std::unique_ptr<SurfaceStress>> stress_;  ///< by body, if it is written
  TrajectoryContents contents_;
};

}  // namespace bem
