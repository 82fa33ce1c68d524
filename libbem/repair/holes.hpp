#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace bem {

/// What fill_holes did.
struct FilledHoles {
  TriangleMesh mesh;                ///< the mesh with what fills its holes at its end
  std::vector<std::size_t> filled;  ///< number of edges of each hole that was filled
  std::vector<std::size_t> left;    ///< of those that are too large, or that nothing fills
  double largest = 0;               ///< area of the largest filling over that of its part
  double area = 0;                  ///< of all fillings [m^2]
};

/// Fills each hole (closed line of open edges) whose filling has at most `part` of the area of the
/// connected part of the surface that it belongs to: with the triangulation of least area, refined
/// to the size of the triangles around it. `part` may be infinite. The mesh must be a manifold with
/// boundary of consistent orientation, as orient_patches() makes it; nothing is returned if it is
/// not, or if CGAL fails. After Liepa (2003); O(n log n) for ordinary holes.
std::optional<FilledHoles> fill_holes(const TriangleMesh& mesh, double part);

}  // namespace bem
