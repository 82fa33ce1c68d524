#pragma once

#include "base/types.hpp"
#include "scene/location.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// Chooses vertices or triangles of one body's mesh.
struct Selection {
  enum class Kind { all, vertices, triangles, box, sphere, plane, group };

  Kind kind = Kind::all;
  std::vector<int> indices;     ///< 0-based, for vertices and triangles
  Vec3 box_min, box_max;        ///< [m], mesh coordinates, min <= max
  Vec3 point = Vec3::Zero();    ///< [m], mesh coordinates: centre of the sphere, or of the plane
  double radius = 0;            ///< [m], of the sphere, > 0
  Vec3 side = Vec3::UnitX();    ///< unit vector to the side of the plane that is chosen
  std::string group;            ///< name; resolve_groups (scene/groups.hpp) puts its selection here
  std::optional<Vec3> normal;   ///< unit vector, mesh coordinates; with a box, sphere or plane
  double normal_tolerance = 0;  ///< largest angle [rad] between it and a triangle's normal
  Location location;

  Selection() : box_min(Vec3::Zero()), box_max(Vec3::Zero()) {}
};

}  // namespace bem
