#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// A mesh without repeated positions, and where the old vertices went.
struct Welded {
  TriangleMesh mesh;                ///< triangles in the old order and orientation
  std::vector<int> node_of_vertex;  ///< -1 for a vertex that no triangle uses
};

/// For each of the `members` the lowest of them with exactly equal coordinates (0 equals -0), -1
/// for the other points. Finite coordinates required. O(n log n).
std::vector<int> first_at_position(const std::vector<Vec3>& points, std::vector<int> members);

/// Joins vertices with exactly equal coordinates (0 equals -0) and drops those that no triangle
/// uses. New vertices keep the order of the first of each group. Every index must be valid and
/// every coordinate finite. O(n log n).
Welded weld(const TriangleMesh& mesh);

}  // namespace bem
