#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>
#include <vector>

namespace bem {

/// What lies along the open edges (those of one triangle) of a welded mesh; edges are half-edges
/// 3 t + k, see mesh/adjacency.hpp.
struct OpenEdges {
  std::vector<int> edges;  ///< all, ascending
  /// For each the open edge that lies on it although its vertices are others: nearer than a
  /// thousandth of both lengths; -1 where there is none.
  std::vector<int> twin;
  std::size_t matched = 0;  ///< how many have a twin
  double tolerance = 0;     ///< smallest distance up to which joining vertices joins all twins [m]
  std::size_t remaining = 0;  ///< open edges after that
};

/// O(n log n) for open edges spread along an axis, O(n^2) if they all lie across it.
OpenEdges find_open_edges(const TriangleMesh& nodes);

/// The first vertex of an open edge that lies on the half-edge between its ends, up to a millionth
/// of its length; -1 if there is none.
int vertex_on_edge(const TriangleMesh& nodes, const OpenEdges& open, int half_edge);

}  // namespace bem
