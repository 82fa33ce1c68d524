#include "collision/surface_topology.hpp"

#include "base/error.hpp"
#include "mesh/adjacency.hpp"

namespace bem {
namespace {

void add_edges(SurfaceTopology& topology) {
  topology.triangle_edges.resize(topology.triangles.size());
  topology.owned_edges.resize(topology.triangles.size());
  for_each_edge(
      sorted_half_edges(topology.triangles), [&](const HalfEdge* first, const HalfEdge* last) {
        require(last - first == 1 || (last - first == 2 && first[0].forward != first[1].forward),
                "an edge has one or two triangles of consistent orientation");
        const int edge = static_cast<int>(topology.edges.size());
        const int triangle = first->index / 3;
        const int other = last - first == 2 ? first[1].index / 3 : -1;
        topology.owned_edges[triangle] |= static_cast<std::uint8_t>(1 << first->index % 3);
        for (const HalfEdge* h = first; h != last; ++h)
          topology.triangle_edges[h->index / 3][h->index % 3] = edge;
        if (first->forward)
          topology.edges.push_back({{first->low, first->high}, {triangle, other}});
        else
          topology.edges.push_back({{first->high, first->low}, {triangle, other}});
      });
}

void add_fans(SurfaceTopology& topology, int vertex_count) {
  topology.fan_begin.assign(vertex_count + 1, 0);
  topology.owned_vertices.resize(topology.triangles.size());
  for (const Triangle& t : topology.triangles)
    for (int v : t) ++topology.fan_begin[v + 1];
  for (int v = 0; v < vertex_count; ++v) topology.fan_begin[v + 1] += topology.fan_begin[v];
  topology.fan_triangles.resize(3 * topology.triangles.size());
  std::vector<int> next(topology.fan_begin.begin(), topology.fan_begin.end() - 1);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int v = topology.triangles[t][k];
      if (next[v] == topology.fan_begin[v])
        topology.owned_vertices[t] |= static_cast<std::uint8_t>(1 << k);
      topology.fan_triangles[next[v]++] = static_cast<int>(t);
    }
  }
}

}  // namespace

SurfaceTopology make_topology(const std::vector<Triangle>& triangles, int vertex_count) {
  for (const Triangle& t : triangles)
    for (int v : t) require(v >= 0 && v < vertex_count, "a triangle has vertices of its mesh");
  SurfaceTopology topology;
  topology.triangles = triangles;
  add_edges(topology);
  add_fans(topology, vertex_count);
  return topology;
}

}  // namespace bem
