#pragma once

#include "base/choices.hpp"
#include "base/material.hpp"
#include "base/types.hpp"
#include "scene/motion_spec.hpp"
#include "scene/selection_spec.hpp"
#include "settings/precompute_settings.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

// A body of a scene as it is written in the scene file; units and coordinates as in scene.hpp.

namespace bem {

/// A path as written, and resolved against the folder of the scene file.
struct FilePath {
  std::string written;
  std::string resolved;
  Location location;
};

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

template <>
struct Choices<FrameMotion> {
  static constexpr std::array<Choice<FrameMotion>, 2> all = {
      {{FrameMotion::moving, "moving"}, {FrameMotion::stationary, "static"}}};
};

/// What keeps displacements free of rigid motion.
enum class Correction {
  projection,    ///< linear, exact momentum: docs/method.md, "One time step"
  least_squares  ///< the paper's section 3.2.1, to compare with
};

template <>
struct Choices<Correction> {
  static constexpr std::array<Choice<Correction>, 2> all = {
      {{Correction::projection, "projection"}, {Correction::least_squares, "least_squares"}}};
};

/// What a body's archive is computed from, or has to agree with.
struct BodySource {
  FilePath mesh;
  double mesh_scale = 1;  ///< > 0
  Material material;
  FilePath material_path;       ///< of a material file; its place only, for an inline material
  PrecomputeSettings settings;  ///< of "precompute"
  Location loads_location;      ///< of "loads" in that, where it is given
};

/// Where a body is put once its geometry is known (simulation/placement.hpp).
struct PlaceSpec {
  Vec3 centre = Vec3::Zero();  ///< of the box around the body [m]
  std::string on;              ///< name of the obstacle that it comes to lie on, or empty
  std::size_t obstacle = 0;    ///< index of that in Scene::obstacles
  std::optional<double>
      gap;  ///< to the obstacle along the direction [m], >= 0; always there with `on`
  std::optional<Vec3> direction;  ///< unit vector in which it falls onto the obstacle; likewise
  Vec3 offset = Vec3::Zero();     ///< of a copy of a repeated body [m]
  Location location, on_location;
};

struct BodySpec {
  std::string name;
  /// Without a path until the archive of a body with a source is prepared
  /// (simulation/scene_preparation.hpp).
  FilePath archive;
  std::optional<BodySource> source;
  std::optional<FilePath> render_mesh;   ///< what trajectories show in place of the surface
  Vec3 position = Vec3::Zero();          ///< of the mesh's origin [m]
  std::optional<PlaceSpec> place;        ///< decides on the position
  AxisAngle rotation;                    ///< world = position + R * mesh coordinates
  Vec3 velocity = Vec3::Zero();          ///< of the centre of mass [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< about the centre of mass [rad/s]
  FrameMotion frame = FrameMotion::moving;
  Correction correction = Correction::projection;
  bool gravity = true;
  bool centrifugal = true;
  double friction = 0;  ///< coefficient, >= 0
  std::vector<Selection> fixed;
  std::vector<HandleSpec> handles;
  std::vector<TractionSpec> tractions;
  Location location;

  bool is_stationary() const { return frame == FrameMotion::stationary; }
  /// Whether its rotation stretches it: only in a frame that rotates, and not in the paper.
  bool has_centrifugal() const {
    return centrifugal && !is_stationary() && correction == Correction::projection;
  }
};

}  // namespace bem
