#pragma once

#include "frame_schedule.hpp"
#include "options.hpp"
#include "render/bound_mesh.hpp"
#include "simulation/archive_source.hpp"
#include "twist.hpp"

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace bem {

class Simulation;

/// What is known of a body before its matrices are loaded.
struct PlannedBody {
  const BodySpec* spec;
  const Archive* archive;
  std::size_t fixed = 0, handled = 0;  ///< vertices (nodes) with prescribed positions
  std::vector<std::size_t> loaded;     ///< triangles by load
  std::shared_ptr<const BoundMesh> render = nullptr;  ///< where one is written
  /// The render mesh is the simulated surface, with faces and texture coordinates as in its file.
  bool shows_surface = false;
};

/// An obstacle, and what its mesh holds with; a plane has none.
struct PlannedObstacle {
  const ObstacleSpec* spec;
  const ObstacleSurface* surface;
};

/// A run that has been checked but for the contents of the matrices.
struct Plan {
  Scene scene;  ///< with the changes of the command line
  long steps = 0;
  FrameSchedule schedule = FrameSchedule::every_steps(1);
  std::vector<PlannedBody> bodies;         ///< refer to `scene`
  std::vector<PlannedObstacle> obstacles;  ///< where contact is enabled
  std::vector<WeldPlan> welds;
  std::vector<Twist> twists;
  double memory = 0;  ///< matrices, columns and history [bytes], about
  std::vector<std::string> warnings, notes;

  Plan() = default;
  Plan(const Plan&) = delete;
  Plan& operator=(const Plan&) = delete;

  /// What bodies are asked to do at a time [s] that no body can; empty if there is nothing.
  std::string impossible(double time) const;
  long frames() const { return schedule.count(steps); }
};

/// Applies the command line to the scene and checks everything against the archives. Throws
/// ErrorCode::invalid_input and ErrorCode::archive.
std::unique_ptr<Plan> make_plan(const Options& options, Scene scene, ArchiveSource& source);

/// Throws ErrorCode::resources if the machine cannot hold the matrices.
void check_memory(const Plan& plan);

/// What is to be said of a scene whatever its archives are.
std::vector<std::string> warnings_of_scene(const Scene& scene);

/// What is to be said of where a simulation starts.
std::vector<std::string> warnings_of_start(const Simulation& simulation);

/// Where a body of the scene is: "  placed at ..." with the boxes of its mesh.
void print_place(std::ostream& out, const BodySpec& body, const BodyGeometry& geometry);

void print_plan(std::ostream& out, const Plan& plan);

}  // namespace bem
