#include "collision/penetration.hpp"

#include "collision/signed_distance.hpp"

namespace bem {

Penetration deepest_penetration(const std::vector<Vec3>& points, const SignedDistance& surface) {
  Penetration deepest;
  if (surface.tree().nodes().empty()) return deepest;
  const BoundingBox& box = surface.tree().nodes().front().box;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!overlap(box, {points[i], points[i]})) continue;
    const double depth = -surface(points[i]);
    if (depth > deepest.depth && surface.surely_contains(points[i]))
      deepest = {depth, static_cast<int>(i)};
  }
  return deepest;
}

Penetration deepest_penetration(const std::vector<Vec3>& points,
                                const std::vector<Triangle>& triangles,
                                const std::vector<Vec3>& vertices) {
  return deepest_penetration(points, SignedDistance(triangles, vertices));
}

Penetration deepest_penetration(const std::vector<Vec3>& points, const CollisionPlane& plane) {
  Penetration deepest;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double depth = -plane.normal.dot(points[i] - plane.point);
    if (depth > deepest.depth) deepest = {depth, static_cast<int>(i)};
  }
  return deepest;
}

}  // namespace bem
