#pragma once

#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace bem {

/// How far [m] the triangles of `moving` get along the unit vector `direction`, from where they
/// are, until they first touch those of `still`, if they come from far away: negative if they have
/// to go back. Nothing if they would pass by. Surfaces are seen from outside only: what is in a
/// closed room lands on its roof. Expected O((m + n + pairs) log n) with the pairs of triangles
/// that lie behind each other.
std::optional<double> free_travel(const TriangleMesh& moving, const TriangleMesh& still,
                                  const Vec3& direction);

}  // namespace bem
