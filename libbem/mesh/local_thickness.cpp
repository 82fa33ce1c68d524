#include "mesh/local_thickness.hpp"

#include "mesh/bounding_tree.hpp"

#include <algorithm>

namespace bem {

std::vector<double> local_thickness(const TriangleMesh& mesh) {
  constexpr double kFacing = -0.5;  // cosine between normals below which triangles face each other
  std::vector<Vec3> centres, normals;
  std::vector<double> edges;
  std::vector<BoundingBox> boxes;
  for (const Triangle& t : mesh.triangles) {
    centres.push_back(triangle_centroid(mesh, t));
    normals.push_back(triangle_normal(mesh, t));
    edges.push_back(longest_edge(mesh, t));
    boxes.push_back(widened({centres.back(), centres.back()}, edges.back()));
  }
  std::vector<double> thickness(mesh.triangles.size(), 1);
  const auto see = [&](int of, const Vec3& apart) {
    const double depth = -apart.dot(normals[of]);  // what lies outside is across a gap
    if (depth >= 0 && apart.norm() < edges[of])
      thickness[of] = std::min(thickness[of], depth / edges[of]);
  };
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    if (normals[a].dot(normals[b]) >= kFacing) continue;
    const Vec3 apart = centres[b] - centres[a];
    see(a, apart);
    see(b, -apart);
  }
  return thickness;
}

}  // namespace bem
