#include "mesh/extent.hpp"

#include "mesh/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// Bounds are enlarged by this part, so that rounding never discards the farthest pair.
constexpr double kRoundingMargin = 1e-12;

struct GridCell {
  int begin = 0, end = 0;
  int left = -1, right = -1;
  Vec3 ball_centre = Vec3::Zero();
  double ball_radius = 0;
  Vec3 direction = Vec3::UnitX();  ///< axis of the cone around all points, seen from the origin
  double half_angle = kPi;
  double reach = 0;  ///< largest distance from the origin
};

/// The points in a tree of cells halved by the longest axis. Cones start at the centre of the box
/// of all points.
class DiameterSearch {
 public:
  explicit DiameterSearch(const std::vector<Vec3>& points)
      : points_(points), origin_(bounding_box(points).centre()) {
    build(0, static_cast<int>(points_.size()));
  }

  double run() {
    start();
    search(0, 0);
    return std::sqrt(best_squared_);
  }

 private:
  static constexpr int kLeafSize = 8;

  int build(int begin, int end) {
    const int index = static_cast<int>(cells_.size());
    cells_.emplace_back();
    const std::vector<Vec3> own(points_.begin() + begin, points_.begin() + end);
    const BoundingBox box = bounding_box(own);
    cells_[index] = bounded_cell(begin, end, box);
    if (end - begin <= kLeafSize) return index;
    int axis = 0;
    (box.max - box.min).maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                     [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    const int left = build(begin, middle);
    const int right = build(middle, end);
    cells_[index].left = left;
    cells_[index].right = right;
    return index;
  }

  GridCell bounded_cell(int begin, int end, const BoundingBox& box) const {
    GridCell cell;
    cell.begin = begin;
    cell.end = end;
    cell.ball_centre = box.centre();
    Vec3 sum = Vec3::Zero();
    for (int i = begin; i < end; ++i) {
      const Vec3 arm = points_[i] - origin_;
      cell.ball_radius = std::max(cell.ball_radius, (points_[i] - cell.ball_centre).norm());
      cell.reach = std::max(cell.reach, arm.norm());
      if (arm.norm() > 0) sum += arm.normalized();
    }
    if (sum.norm() < 0.5) return cell;  // all around the origin: the cone says nothing
    cell.direction = sum.normalized();
    cell.half_angle = 0;
    for (int i = begin; i < end; ++i)
      cell.half_angle = std::max(cell.half_angle, angle(cell.direction, points_[i] - origin_));
    return cell;
  }

  static double angle(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }

  /// No point of cell a is farther than this from a point of cell b.
  double upper_bound(const GridCell& a, const GridCell& b) const {
    const double by_ball = (a.ball_centre - b.ball_centre).norm() + a.ball_radius + b.ball_radius;
    const double widest = angle(a.direction, b.direction) + a.half_angle + b.half_angle;
    // |x - y|^2 = |x|^2 + |y|^2 - 2 |x| |y| cos(angle) grows with the angle.
    const double cosine = widest < kPi ? std::min(0.0, std::cos(widest)) : -1.0;
    const double by_cone =
        std::sqrt(a.reach * a.reach + b.reach * b.reach - 2.0 * a.reach * b.reach * cosine);
    return std::min(by_ball, by_cone) * (1.0 + kRoundingMargin);
  }

  /// A good first distance: from some points on, hop to the farthest point a few times.
  void start() {
    const int n = static_cast<int>(points_.size());
    for (int s = 0; s < 4; ++s) {
      Vec3 from = points_[static_cast<std::size_t>(s) * (n - 1) / 3];
      for (int hop = 0; hop < 3; ++hop) {
        const auto farthest =
            std::max_element(points_.begin(), points_.end(), [&](const Vec3& a, const Vec3& b) {
              return (a - from).squaredNorm() < (b - from).squaredNorm();
            });
        best_squared_ = std::max(best_squared_, (*farthest - from).squaredNorm());
        from = *farthest;
      }
    }
  }

  void search(int a, int b) {
    const GridCell& p = cells_[a];
    const GridCell& q = cells_[b];
    const double bound = upper_bound(p, q);
    if (bound * bound <= best_squared_) return;
    if (p.left < 0 && q.left < 0) {
      compare_points(p, q);
    } else if (a == b) {
      search(p.left, p.right);
      search(p.left, p.left);
      search(p.right, p.right);
    } else if (q.left < 0 || (p.left >= 0 && p.end - p.begin >= q.end - q.begin)) {
      search(p.left, b);
      search(p.right, b);
    } else {
      search(a, q.left);
      search(a, q.right);
    }
  }

  void compare_points(const GridCell& p, const GridCell& q) {
    for (int i = p.begin; i < p.end; ++i)
      for (int j = q.begin; j < q.end; ++j)
        best_squared_ = std::max(best_squared_, (points_[i] - points_[j]).squaredNorm());
  }

  std::vector<Vec3> points_;
  Vec3 origin_;
  std::vector<GridCell> cells_;
  double best_squared_ = 0;
};

}  // namespace

double diameter(const std::vector<Vec3>& points) {
  return points.size() < 2 ? 0.0 : DiameterSearch(points).run();
}

}  // namespace bem
