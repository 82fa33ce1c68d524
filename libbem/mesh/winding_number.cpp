#include "mesh/winding_number.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace bem {

double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - p, v = b - p, w = c - p;
  const double lu = u.norm(), lv = v.norm(), lw = w.norm();
  return 2 * std::atan2(u.dot(v.cross(w)),
                        lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv);
}

double winding_number(const std::vector<Triangle>& triangles, const std::vector<Vec3>& vertices,
                      const Vec3& p) {
  double sum = 0;
  for (const auto& [i, j, k] : triangles)
    sum += solid_angle(p, vertices[i], vertices[j], vertices[k]);
  return sum / (4 * kPi);
}

}  // namespace bem
