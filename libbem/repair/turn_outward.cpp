#include "repair/turn_outward.hpp"

#include "mesh/surface.hpp"

#include <utility>

namespace bem {

std::size_t turn_outward(TriangleMesh& mesh, const std::string& name) {
  const Surface surface = make_surface(mesh, name);
  std::size_t turned = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle& triangle = mesh.triangles[t];
    Triangle nodes = triangle;
    for (int& corner : nodes) corner = surface.node_of_vertex[corner];
    if (nodes == surface.nodes.triangles[t]) continue;
    std::swap(triangle[1], triangle[2]);
    ++turned;
  }
  return turned;
}

}  // namespace bem
