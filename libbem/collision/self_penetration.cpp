#include "collision/self_penetration.hpp"

#include "mesh/closest_points.hpp"
#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bem {
namespace {

/// Winding number of a closed surface around p [van Oosterom and Strackee 1983].
double winding_number(const std::vector<Triangle>& triangles, const std::vector<Vec3>& vertices,
                      const Vec3& p) {
  double sum = 0;
  for (const auto& [i, j, k] : triangles) {
    const Vec3 a = vertices[i] - p, b = vertices[j] - p, c = vertices[k] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * kPi);
}

}  // namespace

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
