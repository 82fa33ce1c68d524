#pragma once

#include "base/types.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace bem {

/// What does not change when a triangle mesh moves: edges, fans of triangles around vertices, and
/// for each vertex and edge one triangle that owns it, so that pairs of triangles visit every pair
/// of vertices or edges once.
struct SurfaceTopology {
  struct Edge {
    std::array<int, 2> vertices;   ///< in the direction of the first triangle's boundary
    std::array<int, 2> triangles;  ///< the second is -1 at the boundary of an open mesh
  };

  std::vector<Triangle> triangles;
  std::vector<Edge> edges;                         ///< sorted by their vertices
  std::vector<std::array<int, 3>> triangle_edges;  ///< edge from corner k to k + 1
  std::vector<int> fan_begin, fan_triangles;       ///< fan of v: [fan_begin[v], fan_begin[v + 1])
  std::vector<std::uint8_t> owned_vertices;        ///< per triangle, bit k: owns its corner k
  std::vector<std::uint8_t> owned_edges;           ///< per triangle, bit k: owns its edge k

  int vertex_count() const { return static_cast<int>(fan_begin.size()) - 1; }
};

/// Throws ErrorCode::internal if a vertex index is out of range or an edge has more than two
/// triangles or two of opposite orientation. O(n log n).
SurfaceTopology make_topology(const std::vector<Triangle>& triangles, int vertex_count);

}  // namespace bem
