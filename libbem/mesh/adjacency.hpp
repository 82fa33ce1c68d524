#pragma once

#include "base/types.hpp"

#include <cstddef>
#include <vector>

namespace bem {

/// One side of an edge: half-edge 3 t + k runs from corner k to corner k + 1 (mod 3) of triangle t.
struct HalfEdge {
  int low;       ///< smaller vertex of the edge
  int high;      ///< larger vertex
  int index;     ///< 3 t + k
  bool forward;  ///< runs from low to high
};

/// All half-edges sorted by (low, high, index), so that those of one edge are neighbours.
/// O(n log n).
std::vector<HalfEdge> sorted_half_edges(const std::vector<Triangle>& triangles);

/// For each half-edge 3 t + k the opposite one in the triangle across the edge. Every edge must
/// have exactly two triangles of consistent orientation (ErrorCode::internal otherwise).
/// O(n log n).
std::vector<int> half_edge_twins(const std::vector<Triangle>& triangles);

/// Calls visit(first, last) with the pointer range of the half-edges of each edge.
template <typename Visit>
void for_each_edge(const std::vector<HalfEdge>& half_edges, Visit visit) {
  const HalfEdge* const end = half_edges.data() + half_edges.size();
  for (const HalfEdge* first = half_edges.data(); first != end;) {
    const HalfEdge* last = first + 1;
    while (last != end && last->low == first->low && last->high == first->high) ++last;
    visit(first, last);
    first = last;
  }
}

}  // namespace bem
