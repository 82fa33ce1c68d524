#include "mesh/self_intersection.hpp"

#include "base/interruption.hpp"
#include "mesh/bounding_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bem {
namespace {

constexpr double kTouching = 1e-9;

/// Signed distances of the points from the plane, those within `tolerance` set to 0.
Vec3 plane_distances(const Vec3& normal, const Vec3& origin, const std::array<Vec3, 3>& points,
                     double tolerance) {
  Vec3 d;
  for (int k = 0; k < 3; ++k) {
    d[k] = normal.dot(points[k] - origin);
    if (std::abs(d[k]) <= tolerance) d[k] = 0;
  }
  return d;
}

bool straddles(const Vec3& d) {
  return d.minCoeff() < 0 && d.maxCoeff() > 0;
}

/// Where the triangle cuts the plane that its corners are `d` away from, as an interval along
/// `axis` (relative to `origin`).
std::pair<double, double> cut_interval(const std::array<Vec3, 3>& points, const Vec3& d,
                                       const Vec3& axis, const Vec3& origin) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto add = [&](double s) {
    low = std::min(low, s);
    high = std::max(high, s);
  };
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const double s = axis.dot(points[k] - origin);
    if (d[k] == 0) add(s);
    if (d[k] * d[next] < 0)
      add(s + (axis.dot(points[next] - origin) - s) * (d[k] / (d[k] - d[next])));
  }
  return {low, high};
}

bool share_a_vertex(const Triangle& s, const Triangle& t) {
  return std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end();
}

}  // namespace

bool triangles_cross(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  double size = 0;
  for (int k = 0; k < 3; ++k)
    size = std::max({size, (a[(k + 1) % 3] - a[k]).norm(), (b[(k + 1) % 3] - b[k]).norm()});
  const double tolerance = kTouching * size;
  const Vec3 normal_a = area_vector(a[0], a[1], a[2]).normalized();
  const Vec3 normal_b = area_vector(b[0], b[1], b[2]).normalized();
  const Vec3 da = plane_distances(normal_b, b[0], a, tolerance);
  if (!straddles(da)) return false;
  const Vec3 db = plane_distances(normal_a, a[0], b, tolerance);
  if (!straddles(db)) return false;
  const Vec3 axis = normal_a.cross(normal_b).normalized();
  const auto [low_a, high_a] = cut_interval(a, da, axis, a[0]);
  const auto [low_b, high_b] = cut_interval(b, db, axis, a[0]);
  return std::min(high_a, high_b) - std::max(low_a, low_b) > tolerance;
}

SelfIntersections find_self_intersections(const TriangleMesh& nodes) {
  SelfIntersections found;
  if (nodes.triangles.empty()) return found;
  const auto corners = [&](int t) { return triangle_corners(nodes, nodes.triangles[t]); };
  auto visit = [&](int s, int t) {
    check_interruption();
    if (share_a_vertex(nodes.triangles[s], nodes.triangles[t])) return;
    const std::pair<int, int> pair = std::minmax(s, t);
    if (!triangles_cross(corners(pair.first), corners(pair.second))) return;
    if (found.count++ == 0 || pair < std::make_pair(found.first, found.second)) {
      found.first = pair.first;
      found.second = pair.second;
    }
  };
  visit_self_overlaps(BoundingTree(nodes.triangles, nodes.vertices), 0, visit);
  return found;
}

}  // namespace bem
