#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>

namespace bem {

/// Steps of a repair that need nothing but triangles: no orientation, no manifold. Indices are in
/// range and coordinates finite. Each step returns how much it changed.

/// Joins vertices up to `distance` [m] apart, in chains, and drops those that no triangle uses.
/// Returns how many vertices were joined with others. O(n log n) unless many vertices share a cube
/// of that size.
std::size_t weld_within(TriangleMesh& mesh, double distance);

/// The same for vertices on open edges alone.
std::size_t weld_rims_within(TriangleMesh& mesh, double distance);

/// Drops triangles that have a vertex twice. O(n).
std::size_t drop_collapsed(TriangleMesh& mesh);

/// Where a vertex lies on an edge of a triangle without area, or on an open edge, up to
/// `distance` [m], the triangles of that edge are split there. Returns the number of edges. At most
/// ten passes of O(n log n).
std::size_t split_edges_at_vertices(TriangleMesh& mesh, double distance);

/// Drops patches of triangles (connected by edges of two triangles) that end somewhere in an open
/// edge and hang on an edge of three or more triangles, as long as each has at most `part` of the
/// area of the mesh. Returns the number of triangles. O(n log n).
std::size_t drop_fins(TriangleMesh& mesh, double part);

/// The same for patches that end in an open edge and hang on nothing.
std::size_t drop_loose_patches(TriangleMesh& mesh, double part);

/// Edges that do not have exactly two triangles. O(n log n).
struct BadEdges {
  std::size_t open = 0;     ///< one triangle
  std::size_t crowded = 0;  ///< three or more

  std::size_t total() const { return open + crowded; }
};
BadEdges count_bad_edges(const TriangleMesh& mesh);

}  // namespace bem
