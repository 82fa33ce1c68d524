#include "repair/crowded_edges.hpp"

#include "mesh/adjacency.hpp"
#include "mesh/two_sided.hpp"
#include "repair/disjoint_sets.hpp"

namespace bem {

TriangleMesh outer_side(const TriangleMesh& mesh) {
  TriangleMesh layers = make_two_sided(mesh).layers;
  const std::size_t n = layers.triangles.size();
  DisjointSets parts(n);
  for_each_edge(sorted_half_edges(layers.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) {
                  for (const HalfEdge* h = first + 1; h != last; ++h)
                    parts.unite(first->index / 3, h->index / 3);
                });
  std::vector<double> volume(n, 0);
  for (std::size_t t = 0; t < n; ++t) {
    const auto [a, b, c] = triangle_corners(layers, layers.triangles[t]);
    volume[parts.find(static_cast<int>(t))] += a.dot(b.cross(c)) / 6;
  }
  std::vector<Triangle> outer;
  for (std::size_t t = 0; t < n; ++t)
    if (volume[parts.find(static_cast<int>(t))] > 0) outer.push_back(layers.triangles[t]);
  layers.triangles = std::move(outer);
  return layers;
}

}  // namespace bem
