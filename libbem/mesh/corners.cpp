#include "mesh/corners.hpp"

#include "mesh/adjacency.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

CornerSectors::CornerSectors(const TriangleMesh& mesh, double angle_deg) {
  const std::vector<int> twins = half_edge_twins(mesh.triangles);
  const double least_cosine = std::cos(angle_deg * kPi / 180);
  std::vector<Vec3> normals;
  for (const Triangle& t : mesh.triangles) normals.push_back(triangle_normal(mesh, t));
  const auto is_sharp = [&](int half_edge) {
    return normals[half_edge / 3].dot(normals[twins[half_edge] / 3]) < least_cosine;
  };
  // half-edge 3 t + k leaves corner k; the one before it, 3 t + (k + 2) % 3, comes back to it
  std::vector<std::vector<int>> leaving(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      leaving[mesh.triangles[t][k]].push_back(static_cast<int>(3 * t) + k);
  sectors_.resize(mesh.vertices.size());
  for (std::size_t v = 0; v < leaving.size(); ++v) {
    if (leaving[v].empty()) continue;
    // counter-clockwise around the vertex, beginning behind a sharp edge if there is one
    const auto first = std::find_if(leaving[v].begin(), leaving[v].end(), is_sharp);
    const int start = first == leaving[v].end() ? leaving[v].front() : *first;
    for (int edge = start;;) {
      if (edge == start || is_sharp(edge)) sectors_[v].emplace_back();
      sectors_[v].back().push_back(edge / 3);
      edge = twins[3 * (edge / 3) + (edge + 2) % 3];
      if (edge == start) break;
    }
    for (std::vector<int>& sector : sectors_[v]) std::sort(sector.begin(), sector.end());
  }
}

}  // namespace bem
