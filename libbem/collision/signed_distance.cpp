#include "collision/signed_distance.hpp"

#include "collision/moving_surface.hpp"
#include "mesh/winding_number.hpp"

#include <algorithm>
#include <limits>

namespace bem {
namespace {

/// The triangle nearest to a point.
class NearestTriangle {
 public:
  NearestTriangle(const BoundingTree& tree, const MovingSurface& surface, const Vec3& p)
      : surface_(surface), p_(p) {
    auto look = [this](int triangle) { look_at(triangle); };
    visit_near(tree, 0, p, nearest_, look);
  }

  double signed_distance() const {
    Vec3 normal = triangle_normal(surface_, triangle_, 0);
    if (closest_.feature == NearestPoint::Feature::edge)
      normal =
          edge_normal(surface_, surface_.topology->triangle_edges[triangle_][closest_.index], 0);
    if (closest_.feature == NearestPoint::Feature::corner)
      normal = vertex_normal(surface_, surface_.topology->triangles[triangle_][closest_.index], 0);
    const Vec3 between = p_ - closest_.point;
    return normal.dot(between) < 0 ? -between.norm() : between.norm();
  }

 private:
  void look_at(int triangle) {
    const auto [a, b, c] = surface_.triangle(triangle, 0);
    const NearestPoint closest = closest_on_triangle(p_, a, b, c);
    const double distance = (p_ - closest.point).squaredNorm();
    if (distance >= nearest_ || unit_normal(a, b, c).isZero(0)) return;
    nearest_ = distance;
    closest_ = closest;
    triangle_ = triangle;
  }

  const MovingSurface& surface_;
  const Vec3& p_;
  double nearest_ = std::numeric_limits<double>::infinity();
  NearestPoint closest_;
  int triangle_ = 0;
};

}  // namespace

SignedDistance::SignedDistance(const std::vector<Triangle>& triangles,
                               const std::vector<Vec3>& vertices)
    : topology_(make_topology(triangles, static_cast<int>(vertices.size()))),
      vertices_(&vertices),
      tree_(triangles, vertices),
      closed_(std::all_of(topology_.edges.begin(), topology_.edges.end(),
                          [](const auto& edge) { return edge.triangles[1] >= 0; })) {}

double SignedDistance::operator()(const Vec3& p) const {
  if (topology_.triangles.empty()) return std::numeric_limits<double>::infinity();
  const MovingSurface surface{0, &topology_, vertices_, vertices_};
  return NearestTriangle(tree_, surface, p).signed_distance();
}

bool SignedDistance::surely_contains(const Vec3& p) const {
  return !closed_ || winding_number(topology_.triangles, *vertices_, p) > 0.5;
}

}  // namespace bem
