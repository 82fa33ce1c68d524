#pragma once

#include "collision/collision_detector.hpp"
#include "collision/signed_distance.hpp"

namespace bem {

/// The deepest penetration found, and where.
struct Penetration {
  double depth = 0;  ///< [m], 0 if nothing penetrates
  int vertex = -1;   ///< the deepest vertex, -1 if nothing penetrates
};

/// Deepest of the `points` inside a surface: its distance to the nearest triangle. Inside is
/// what that triangle's pseudonormal and, for a closed surface, the winding number say. O((n + m)
/// log m) for n points in the surface's box, and O(m) for every point that is deeper than those
/// before.
Penetration deepest_penetration(const std::vector<Vec3>& points, const SignedDistance& surface);
Penetration deepest_penetration(const std::vector<Vec3>& points,
                                const std::vector<Triangle>& triangles,
                                const std::vector<Vec3>& vertices);

/// Deepest of the points below the plane. O(n).
Penetration deepest_penetration(const std::vector<Vec3>& points, const CollisionPlane& plane);

}  // namespace bem
