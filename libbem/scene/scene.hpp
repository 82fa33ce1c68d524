#pragma once

#include "friction/friction_options.hpp"
#include "output/output_format.hpp"
#include "scene/body_spec.hpp"

// A scene as it is written in its JSON file (docs/scene-format.md), with the defaults filled in.
// SI units; angles are radians here and degrees in the file. What is called "mesh coordinates" is
// the body's own mesh before it is placed, everything else is in world coordinates. Every part
// remembers its place in the file, so that later checks can name it (error_at).

namespace bem {

/// The half space below a plane.
struct PlaneObstacle {
  Vec3 point = Vec3::Zero();    ///< any point of the plane [m]
  Vec3 normal = Vec3::UnitY();  ///< unit vector, out of the obstacle
};

/// A rigid surface: any set of triangles. Before the motion, world = position + rotation * scale x.
struct MeshObstacle {
  FilePath mesh;
  Vec3 scale = Vec3::Ones();     ///< of the mesh's coordinates, all > 0
  Vec3 position = Vec3::Zero();  ///< of the mesh's origin [m]
  AxisAngle rotation;
  Motion motion;
};

struct ObstacleSpec {
  std::string name;
  std::variant<PlaneObstacle, MeshObstacle> shape;
  double friction = 0;  ///< coefficient, >= 0
  Location location;
};

/// One side of a joint.
struct JointEnd {
  std::size_t body = 0;       ///< index in Scene::bodies
  Vec3 point = Vec3::Zero();  ///< initial world position [m]; point joints only
  Location location;
};

enum class JointType {
  point,  ///< a point of one body stays on a point of another
  weld    ///< the surfaces stay together where they touch at the start
};

template <>
struct Choices<JointType> {
  static constexpr std::array<Choice<JointType>, 2> all = {
      {{JointType::point, "point"}, {JointType::weld, "weld"}}};
};

struct JointSpec {
  JointType type = JointType::point;
  JointEnd a;
  std::optional<JointEnd> b;  ///< none: a point joint to the world, where its point is at the start
  double tolerance = 1e-6;    ///< > 0 [m]
  Location location;
};

/// How the coefficients of two surfaces make the one between them.
enum class FrictionCombine { max, min, average, multiply };

template <>
struct Choices<FrictionCombine> {
  static constexpr std::array<Choice<FrictionCombine>, 4> all = {
      {{FrictionCombine::max, "max"},
       {FrictionCombine::min, "min"},
       {FrictionCombine::average, "average"},
       {FrictionCombine::multiply, "multiply"}}};
};

struct ContactSpec {
  bool enabled = false;     ///< true in a scene that has a "contact" without "enabled"
  bool self = false;        ///< contact of a body with itself too
  double tolerance = 1e-6;  ///< > 0 [m]
  FrictionCombine friction_combine = FrictionCombine::max;
  FrictionMethod solver = FrictionMethod::newton;
  Location location;
};

enum class OutputField { positions, velocities, tractions, stress, contacts };

template <>
struct Choices<OutputField> {
  static constexpr std::array<Choice<OutputField>, 5> all = {
      {{OutputField::positions, "positions"},
       {OutputField::velocities, "velocities"},
       {OutputField::tractions, "tractions"},
       {OutputField::stress, "stress"},
       {OutputField::contacts, "contacts"}}};
};

/// Which surface of a body with a render mesh is written.
enum class OutputSurface { render, simulation, both };

template <>
struct Choices<OutputSurface> {
  static constexpr std::array<Choice<OutputSurface>, 3> all = {
      {{OutputSurface::render, "render"},
       {OutputSurface::simulation, "simulation"},
       {OutputSurface::both, "both"}}};
};

struct OutputSpec {
  /// Each at most once, at least one.
  std::vector<const OutputFormat*> formats = {find_output_format("hdf5")};
  int every = 1;                                               ///< steps from frame to frame, >= 1
  std::vector<OutputField> fields = {OutputField::positions};  ///< each at most once
  OutputSurface surface = OutputSurface::render;
  Location location;
};

/// The name in trajectories of the simulated surface of a body whose render mesh has its own.
inline std::string simulation_name(const std::string& body) {
  return body + "-simulation";
}

/// Where bodies start if not as the scene places them (simulation/initial_state.hpp).
struct InitialStateSpec {
  FilePath file;
  bool is_checkpoint = false;       ///< else a trajectory
  int frame = -1;                   ///< of a trajectory; negative: from the end
  std::vector<std::size_t> bodies;  ///< indices in Scene::bodies; none: all that the file has
  Location location;
};

struct Scene {
  double time_step = 0;          ///< [s], > 0; 0 until an automatic one is chosen
  double duration = 0;           ///< [s], >= 0
  Vec3 gravity = Vec3::Zero();   ///< acceleration [m/s^2]
  std::vector<BodySpec> bodies;  ///< at least one; no two names of bodies and obstacles are equal
  std::vector<ObstacleSpec> obstacles;
  std::vector<JointSpec> joints;
  ContactSpec contact;
  OutputSpec output;
  std::optional<InitialStateSpec> initial_state;
  std::vector<std::string> files;  ///< the scene file, and those that it includes
  std::string text;                ///< of the scene file
  Location location;
  Location time_step_location;
};

}  // namespace bem
