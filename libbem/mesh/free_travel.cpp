#include "mesh/free_travel.hpp"

#include "mesh/bounding_tree.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEdgeTolerance = 1e-12;  // of the size: points on an edge are in its triangle

/// The mesh in axes whose third one is the direction.
TriangleMesh seen_along(TriangleMesh mesh, const Mat3& axes) {
  for (Vec3& v : mesh.vertices) v = axes * v;
  return mesh;
}

Mat3 axes_of(const Vec3& direction) {
  Mat3 axes;
  axes.row(0) = direction.unitOrthogonal();
  axes.row(1) = direction.cross(Vec3(axes.row(0)));
  axes.row(2) = direction;
  return axes;
}

/// The shadows of triangles on the plane across the direction.
BoundingTree shadow_tree(const TriangleMesh& mesh, double margin) {
  std::vector<BoundingBox> boxes;
  for (const Triangle& t : mesh.triangles) {
    const auto corners = triangle_corners(mesh, t);
    BoundingBox box = widened(bounding_box({corners.begin(), corners.end()}), margin);
    box.min[2] = box.max[2] = 0;
    boxes.push_back(box);
  }
  return BoundingTree(boxes);
}

using CornerPoints = std::array<Vec3, 3>;

double shadow_cross(const Vec3& a, const Vec3& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// Depth, along the direction, of the triangle at the shadow of `p`; not a number beside it.
double depth_at(const CornerPoints& c, const Vec3& p) {
  const double area = shadow_cross(c[1] - c[0], c[2] - c[0]);
  if (area == 0) return std::numeric_limits<double>::quiet_NaN();
  double depth = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = c[(k + 1) % 3], &b = c[(k + 2) % 3];
    const double weight = shadow_cross(a - p, b - p) / area;
    if (weight < -kEdgeTolerance) return std::numeric_limits<double>::quiet_NaN();
    depth += weight * c[k][2];
  }
  return depth;
}

/// How much deeper edge c d is than edge a b where their shadows cross; infinite if they do not.
double depth_between(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double turn = shadow_cross(b - a, d - c);
  if (turn == 0) return kInfinity;
  const double s = shadow_cross(c - a, d - c) / turn, t = shadow_cross(c - a, b - a) / turn;
  if (std::min({s, t, 1 - s, 1 - t}) < -kEdgeTolerance) return kInfinity;
  return c[2] + t * (d - c)[2] - a[2] - s * (b - a)[2];
}

/// How far a triangle gets until it touches another. The difference of depths is linear where both
/// shadows are, so that it is least at a corner of one or where edges cross.
double travel_of(const CornerPoints& moving, const CornerPoints& still) {
  double travel = kInfinity;
  for (const Vec3& p : moving) travel = std::fmin(travel, depth_at(still, p) - p[2]);
  for (const Vec3& p : still) travel = std::fmin(travel, p[2] - depth_at(moving, p));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      travel = std::fmin(
          travel, depth_between(moving[i], moving[(i + 1) % 3], still[j], still[(j + 1) % 3]));
  return travel;
}

}  // namespace

std::optional<double> free_travel(const TriangleMesh& moving, const TriangleMesh& still,
                                  const Vec3& direction) {
  if (moving.triangles.empty() || still.triangles.empty()) return std::nullopt;
  const Mat3 axes = axes_of(direction);
  const TriangleMesh a = seen_along(moving, axes), b = seen_along(still, axes);
  const double margin = kEdgeTolerance * bounding_box(a.vertices).diagonal();
  const BoundingTree tree_a = shadow_tree(a, margin), tree_b = shadow_tree(b, margin);
  double travel = kInfinity;
  const auto visit = [&](int s, int t) {
    travel = std::fmin(travel, travel_of(triangle_corners(a, a.triangles[s]),
                                         triangle_corners(b, b.triangles[t])));
  };
  visit_overlaps(tree_a, 0, tree_b, 0, visit);
  return travel < kInfinity ? std::optional(travel) : std::nullopt;
}

}  // namespace bem
