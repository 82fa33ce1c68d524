#include "contact/penetration.hpp"

#include "contact/closest_points.hpp"
#include "contact/moving_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bem {
namespace {

double squared_distance(const Vec3& p, const BoundingBox& box) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).squaredNorm();
}

/// How often a closed surface goes round a point, by the solid angles of its triangles [Van
/// Oosterom and Strackee 1983]. O(n).
double winding_number(const Vec3& p, const std::vector<Triangle>& triangles,
                      const std::vector<Vec3>& vertices) {
  double sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 a = vertices[t[0]] - p, b = vertices[t[1]] - p, c = vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum +=
        std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2 * kPi);
}

/// The triangle nearest to a point.
class NearestTriangle {
 public:
  NearestTriangle(const BoundingTree& tree, const MovingSurface& surface, const Vec3& p)
      : tree_(tree), surface_(surface), p_(p) {
    visit(0);
  }

  /// Distance to the surface, negative inside.
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
  void visit(int index) {
    const BoundingTree::Node& node = tree_.nodes()[index];
    if (squared_distance(p_, node.box) >= nearest_) return;
    if (!node.leaf()) {
      const int first = index + 1;
      const bool ahead = squared_distance(p_, tree_.nodes()[first].box) <=
                         squared_distance(p_, tree_.nodes()[node.right].box);
      visit(ahead ? first : node.right);
      visit(ahead ? node.right : first);
      return;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const auto [a, b, c] = surface_.triangle(tree_.order()[i], 0);
      const NearestPoint closest = closest_on_triangle(p_, a, b, c);
      const double distance = (p_ - closest.point).squaredNorm();
      if (distance >= nearest_) continue;
      nearest_ = distance;
      closest_ = closest;
      triangle_ = tree_.order()[i];
    }
  }

  const BoundingTree& tree_;
  const MovingSurface& surface_;
  const Vec3& p_;
  double nearest_ = std::numeric_limits<double>::infinity();
  NearestPoint closest_;
  int triangle_ = 0;
};

}  // namespace

PenetrableSurface::PenetrableSurface(const std::vector<Triangle>& triangles,
                                     std::vector<Vec3> vertices)
    : vertices_(std::move(vertices)),
      topology_(make_topology(triangles, static_cast<int>(vertices_.size()))),
      tree_(triangles, vertices_),
      closed_(std::all_of(topology_.edges.begin(), topology_.edges.end(),
                          [](const auto& edge) { return edge.triangles[1] >= 0; })) {}

Penetration PenetrableSurface::deepest(const std::vector<Vec3>& points) const {
  Penetration deepest;
  if (topology_.triangles.empty()) return deepest;
  const MovingSurface surface{0, &topology_, &vertices_, &vertices_};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (squared_distance(points[i], tree_.nodes().front().box) > 0) continue;
    const double depth = -NearestTriangle(tree_, surface, points[i]).signed_distance();
    // next to a fold of a deformed surface the nearest triangle may be the wrong way round
    if (depth > deepest.depth &&
        (!closed_ || winding_number(points[i], topology_.triangles, vertices_) > 0.5))
      deepest = {depth, static_cast<int>(i)};
  }
  return deepest;
}

Penetration deepest_penetration(const std::vector<Vec3>& points,
                                const std::vector<Triangle>& triangles,
                                const std::vector<Vec3>& vertices) {
  return PenetrableSurface(triangles, vertices).deepest(points);
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
