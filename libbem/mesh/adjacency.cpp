#include "mesh/adjacency.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <tuple>

namespace bem {

std::vector<HalfEdge> sorted_half_edges(const std::vector<Triangle>& triangles) {
  std::vector<HalfEdge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][k];
      const int to = triangles[t][(k + 1) % 3];
      edges.push_back(
          {std::min(from, to), std::max(from, to), static_cast<int>(3 * t) + k, from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.index) < std::tie(b.low, b.high, b.index);
  });
  return edges;
}

std::vector<int> half_edge_twins(const std::vector<Triangle>& triangles) {
  std::vector<int> twins(3 * triangles.size());
  for_each_edge(sorted_half_edges(triangles), [&](const HalfEdge* first, const HalfEdge* last) {
    require(last - first == 2 && first[0].forward != first[1].forward,
            "an edge has two triangles of consistent orientation");
    twins[first[0].index] = first[1].index;
    twins[first[1].index] = first[0].index;
  });
  return twins;
}

}  // namespace bem
