#pragma once

#include "contact/collision_detector.hpp"

namespace bem {

/// The deepest penetration found, and where.
struct Penetration {
  double depth = 0;  ///< [m], 0 if nothing penetrates
  int vertex = -1;   ///< the deepest vertex, -1 if nothing penetrates
};

/// Deepest vertex of `vertices` inside the closed surface: distance to the surface of the vertices
/// that are inside (winding number). For tests and statistics: O(n log m) outside the box of the
/// surface, O(m) per vertex in it.
Penetration deepest_penetration(const std::vector<Vec3>& vertices,
                                const std::vector<Triangle>& triangles,
                                const std::vector<Vec3>& surface_vertices);

/// Deepest vertex below the plane. O(n).
Penetration deepest_penetration(const std::vector<Vec3>& vertices, const CollisionPlane& plane);

}  // namespace bem
