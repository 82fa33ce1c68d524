#pragma once

#include "base/types.hpp"
#include "scene/location.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

// A scene as it is written in its JSON file (docs/scene-format.md), with the defaults filled in.
// SI units; angles are radians here and degrees in the file. What is called "mesh coordinates" is
// the body's own mesh before it is placed, everything else is in world coordinates. Every part
// remembers its place in the file, so that later checks can name it (error_at).

namespace bem {

/// A path as written, and resolved against the folder of the scene file.
struct FilePath {
  std::string written;
  std::string resolved;
  Location location;
};

/// Rotation by `angle` [rad], of any size and sign, about the unit vector `axis`.
struct AxisAngle {
  Vec3 axis = Vec3::UnitX();
  double angle = 0;

  Mat3 matrix() const;
};

/// Chooses vertices or triangles of one body's mesh.
struct Selection {
  enum class Kind { all, vertices, triangles, box };

  Kind kind = Kind::all;
  std::vector<int> indices;     ///< 0-based, for vertices and triangles
  Vec3 box_min, box_max;        ///< [m], mesh coordinates, min <= max
  std::optional<Vec3> normal;   ///< unit vector, mesh coordinates, with Kind::box only
  double normal_tolerance = 0;  ///< largest angle [rad] between it and a triangle's normal
  Location location;

  Selection() : box_min(Vec3::Zero()), box_max(Vec3::Zero()) {}
};

/// One point of a factor over time.
struct ProfilePoint {
  double time = 0;  ///< [s]
  double factor = 0;
};

/// Factor over time, with increasing times (profile_value evaluates it); empty is the factor 1.
using Profile = std::vector<ProfilePoint>;

/// Where a motion has brought things at one time (motion_at interpolates).
struct Keyframe {
  double time = 0;                ///< [s]
  Vec3 translate = Vec3::Zero();  ///< [m]
  AxisAngle rotate;
  Vec3 about = Vec3::Zero();  ///< centre of the rotation [m]
};

/// Keyframes with increasing times; empty is no motion.
using Motion = std::vector<Keyframe>;

/// Vertices whose positions are prescribed.
struct HandleSpec {
  Selection select;
  Motion motion;
  std::optional<double> release_time;  ///< the vertices are free after it [s]
  Location location;
};

/// Load on triangles of the undeformed surface: `traction`, or the pressure along -normal.
struct TractionSpec {
  Selection select;
  std::variant<Vec3, double> load;  ///< traction vector [Pa, world axes] or pressure [Pa]
  Profile profile;
  bool follow = false;  ///< the load turns with the body's frame; always so for a pressure
  Location location;

  bool is_pressure() const { return load.index() == 1; }
};

/// How the frame moves in which a body's displacements are measured.
enum class FrameMotion {
  moving,     ///< with the body
  stationary  ///< "static" in the file: it stays where the body started
};

struct BodySpec {
  std::string name;
  FilePath archive;
  Vec3 position = Vec3::Zero();          ///< of the mesh's origin [m]
  AxisAngle rotation;                    ///< world = position + R * mesh coordinates
  Vec3 velocity = Vec3::Zero();          ///< of the centre of mass [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< about the centre of mass [rad/s]
  FrameMotion frame = FrameMotion::moving;
  bool gravity = true;
  double friction = 0;  ///< coefficient, >= 0
  std::vector<Selection> fixed;
  std::vector<HandleSpec> handles;
  std::vector<TractionSpec> tractions;
  Location location;
};

/// The half space below a plane.
struct PlaneObstacle {
  Vec3 point = Vec3::Zero();    ///< any point of the plane [m]
  Vec3 normal = Vec3::UnitY();  ///< unit vector, out of the obstacle
};

/// A rigid closed surface.
struct MeshObstacle {
  FilePath mesh;
  Vec3 position = Vec3::Zero();  ///< of the mesh's origin [m]
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

struct JointSpec {
  JointType type = JointType::point;
  JointEnd a;
  std::optional<JointEnd> b;  ///< none: a point joint to the world, where its point is at the start
  double tolerance = 1e-6;  ///< > 0 [m]
  Location location;
};

/// How the coefficients of two surfaces make the one between them.
enum class FrictionCombine { max, min, average, multiply };

/// How the contact forces are found (docs/method.md).
enum class ContactSolver { newton, nsgs, staggered };

struct ContactSpec {
  bool enabled = false;     ///< true in a scene that has a "contact" without "enabled"
  bool self = false;        ///< contact of a body with itself too
  double tolerance = 1e-6;  ///< > 0 [m]
  FrictionCombine friction_combine = FrictionCombine::max;
  ContactSolver solver = ContactSolver::newton;
  Location location;
};

enum class OutputFormat { obj, hdf5, vtp, pc2 };
enum class OutputField { positions, tractions };

struct OutputSpec {
  std::vector<OutputFormat> formats = {OutputFormat::hdf5};    ///< each at most once, at least one
  int every = 1;                                               ///< steps from frame to frame, >= 1
  std::vector<OutputField> fields = {OutputField::positions};  ///< each at most once
  Location location;
};

struct Scene {
  double time_step = 0;          ///< [s], > 0
  double duration = 0;           ///< [s], >= 0
  Vec3 gravity = Vec3::Zero();   ///< acceleration [m/s^2]
  std::vector<BodySpec> bodies;  ///< at least one; no two names of bodies and obstacles are equal
  std::vector<ObstacleSpec> obstacles;
  std::vector<JointSpec> joints;
  ContactSpec contact;
  OutputSpec output;
  Location location;
  Location time_step_location;
};

}  // namespace bem
