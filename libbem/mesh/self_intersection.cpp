#include "mesh/self_intersection.hpp"

#include "base/interruption.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace bem {
namespace {

constexpr double kTouching = 1e-9;

/// Signed distances of the points from the plane, those within `tolerance` set to 0.
Vec3 plane_distances(const Vec3& normal, const Vec3& origin, const Vec3 (&points)[3],
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
std::pair<double, double> cut_interval(const Vec3 (&points)[3], const Vec3& d, const Vec3& axis,
                                       const Vec3& origin) {
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

struct Node {
  BoundingBox box;
  int begin, end;  // range of the sorted triangles
  int left = -1;   // children, -1 in a leaf
  int right = -1;
};

/// Bounding-box tree over the triangles of a mesh, halved by the longest axis of the centroids.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    for (const Triangle& t : mesh.triangles) centroids_.push_back(triangle_centroid(mesh, t));
    if (!order_.empty()) build(0, static_cast<int>(order_.size()));
  }

  SelfIntersections find() {
    if (!nodes_.empty()) compare(0, 0);
    return found_;
  }

 private:
  static constexpr int kLeafSize = 4;

  BoundingBox triangle_box(int t) const {
    const Triangle& c = mesh_.triangles[t];
    BoundingBox box;
    box.min = box.max = mesh_.vertices[c[0]];
    for (int k = 1; k < 3; ++k) {
      box.min = box.min.cwiseMin(mesh_.vertices[c[k]]);
      box.max = box.max.cwiseMax(mesh_.vertices[c[k]]);
    }
    return box;
  }

  int build(int begin, int end) {
    Node node;
    node.begin = begin;
    node.end = end;
    node.box = triangle_box(order_[begin]);
    BoundingBox centres{centroids_[order_[begin]], centroids_[order_[begin]]};
    for (int i = begin + 1; i < end; ++i) {
      const BoundingBox box = triangle_box(order_[i]);
      node.box.min = node.box.min.cwiseMin(box.min);
      node.box.max = node.box.max.cwiseMax(box.max);
      centres.min = centres.min.cwiseMin(centroids_[order_[i]]);
      centres.max = centres.max.cwiseMax(centroids_[order_[i]]);
    }
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    if (end - begin <= kLeafSize) return index;
    int axis = 0;
    (centres.max - centres.min).maxCoeff(&axis);
    const int middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) {
                       const double ca = centroids_[a][axis], cb = centroids_[b][axis];
                       return ca != cb ? ca < cb : a < b;
                     });
    const int left = build(begin, middle);
    const int right = build(middle, end);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
  }

  static bool overlap(const BoundingBox& a, const BoundingBox& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
  }

  /// Every pair of triangles below nodes a and b, each pair once.
  void compare(int a, int b) {
    const Node& p = nodes_[a];
    const Node& q = nodes_[b];
    if (!overlap(p.box, q.box)) return;
    check_interruption();
    if (a == b && p.left >= 0) {
      compare(p.left, p.left);
      compare(p.left, p.right);
      compare(p.right, p.right);
    } else if (p.left < 0 && q.left < 0) {
      compare_leaves(p, q, a == b);
    } else if (q.left < 0 || (p.left >= 0 && p.end - p.begin >= q.end - q.begin)) {
      compare(p.left, b);
      compare(p.right, b);
    } else {
      compare(a, q.left);
      compare(a, q.right);
    }
  }

  void compare_leaves(const Node& p, const Node& q, bool same) {
    for (int i = p.begin; i < p.end; ++i)
      for (int j = same ? i + 1 : q.begin; j < q.end; ++j) compare_triangles(order_[i], order_[j]);
  }

  void compare_triangles(int s, int t) {
    const Triangle& u = mesh_.triangles[s];
    const Triangle& v = mesh_.triangles[t];
    for (int corner : u)
      if (corner == v[0] || corner == v[1] || corner == v[2]) return;
    if (!overlap(triangle_box(s), triangle_box(t))) return;
    const auto& p = mesh_.vertices;
    if (!triangles_cross({p[u[0]], p[u[1]], p[u[2]]}, {p[v[0]], p[v[1]], p[v[2]]})) return;
    const std::pair<int, int> pair = std::minmax(s, t);
    if (found_.count++ == 0 || pair < std::make_pair(found_.first, found_.second)) {
      found_.first = pair.first;
      found_.second = pair.second;
    }
  }

  const TriangleMesh& mesh_;
  std::vector<int> order_;
  std::vector<Vec3> centroids_;
  std::vector<Node> nodes_;
  SelfIntersections found_;
};

}  // namespace

bool triangles_cross(const Vec3 (&a)[3], const Vec3 (&b)[3]) {
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
  return TriangleTree(nodes).find();
}

}  // namespace bem
