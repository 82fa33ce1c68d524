#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// How thick a body is at each triangle of its outward surface, as a part of the triangle's longest
/// edge: the depth of the highest triangle below it that faces the other way and is no farther than
/// that edge, at most 1. Depths are those of centroids. O(n log n) if few triangles are that close.
std::vector<double> local_thickness(const TriangleMesh& mesh);

/// Thickness below which the Galerkin method needs more exact integrals and matrices.
inline constexpr double kThinBody = 0.3;

}  // namespace bem
