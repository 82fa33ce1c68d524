#include "mesh/body_geometry.hpp"

#include "mesh/bisection.hpp"
#include "mesh/extent.hpp"
#include "mesh/ordering.hpp"

namespace bem {

BodyGeometry make_geometry(const Surface& surface, double density) {
  BodyGeometry g;
  g.input = surface.input;
  g.mass = mass_properties(surface.nodes, density);
  const std::vector<int> order = bisection_order(surface.nodes.vertices);
  std::vector<int> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    new_index[order[i]] = static_cast<int>(i);
    g.nodes.vertices.push_back(surface.nodes.vertices[order[i]] - g.mass.centre);
  }
  for (int node : surface.node_of_vertex)
    g.node_of_vertex.push_back(node < 0 ? -1 : new_index[node]);
  std::vector<Vec3> centroids;
  for (const Triangle& t : surface.nodes.triangles)
    centroids.push_back(triangle_centroid(surface.nodes, t));
  g.triangle_order = hilbert_order(centroids);
  for (int t : g.triangle_order) {
    const Triangle& old = surface.nodes.triangles[t];
    g.nodes.triangles.push_back({new_index[old[0]], new_index[old[1]], new_index[old[2]]});
  }
  g.extent = diameter(g.nodes.vertices);
  return g;
}

TriangleMesh surface_at_rest(const BodyGeometry& geometry) {
  TriangleMesh surface = geometry.nodes;
  for (Vec3& x : surface.vertices) x += geometry.mass.centre;
  return surface;
}

}  // namespace bem
