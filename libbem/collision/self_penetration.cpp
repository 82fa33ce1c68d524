#include "collision/self_penetration.hpp"

#include "mesh/closest_points.hpp"
#include "mesh/triangle_mesh.hpp"
#include "mesh/winding_number.hpp"

#include <algorithm>
#include <limits>

namespace bem {
Penetration deepest_self_penetration(const std::vector<Triangle>& triangles,
                                     const std::vector<Vec3>& vertices, double reach) {
  std::vector<Vec3> normals(vertices.size(), Vec3::Zero()), faces;
  for (const auto& [i, j, k] : triangles) {
    faces.push_back(area_vector(vertices[i], vertices[j], vertices[k]).normalized());
    for (int v : {i, j, k}) normals[v] += faces.back();
  }
  Penetration deepest;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const int self = static_cast<int>(v);
    const Vec3& p = vertices[v];
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [i, j, k] = triangles[t];
      if (i == self || j == self || k == self || faces[t].dot(normals[v]) >= 0) continue;
      const Vec3 q = closest_on_triangle(p, vertices[i], vertices[j], vertices[k]).point;
      nearest = std::min(nearest, (p - q).norm());
    }
    if (nearest > reach || nearest <= deepest.depth) continue;
    const Vec3 outside = p + 1e-6 * reach * normals[v].normalized();
    if (winding_number(triangles, vertices, outside) > 0.5) deepest = {nearest, self};
  }
  return deepest;
}

}  // namespace bem
