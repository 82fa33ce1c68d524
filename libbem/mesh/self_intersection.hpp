#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <cstddef>

namespace bem {

/// Pairs of triangles that cut through each other.
struct SelfIntersections {
  std::size_t count = 0;
  int first = -1;  ///< the pair with the smallest indices, first < second; -1 if there is none
  int second = -1;
};

/// Do the two triangles cross along a segment? Touching (a common point or edge, one plane) does
/// not count; lengths below 1e-9 of the longest edge are touching. After Moeller (1997).
bool triangles_cross(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

/// All crossing pairs of triangles that share no vertex. O(n log n) for a mesh of evenly sized
/// triangles, plus the number of pairs.
SelfIntersections find_self_intersections(const TriangleMesh& nodes);

}  // namespace bem
