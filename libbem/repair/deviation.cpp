#include "repair/deviation.hpp"

#include "mesh/bounding_tree.hpp"
#include "mesh/closest_points.hpp"

#include <limits>

namespace bem {
namespace {

class ClosestPoint {
 public:
  explicit ClosestPoint(const TriangleMesh& mesh)
      : mesh_(mesh), tree_(mesh.triangles, mesh.vertices) {}

  /// The point of the surface closest to p.
  Vec3 operator()(const Vec3& p) {
    best_ = std::numeric_limits<double>::infinity();
    visit(0, p);
    return point_;
  }

 private:
  double bound(int node, const Vec3& p) const {
    return squared_distance({p, p}, tree_.nodes()[node].box);
  }

  void visit(int n, const Vec3& p) {
    const BoundingTree::Node& node = tree_.nodes()[n];
    if (node.leaf()) {
      for (int i = node.begin; i < node.end; ++i) try_triangle(tree_.order()[i], p);
      return;
    }
    int near = n + 1, far = node.right;
    if (bound(far, p) < bound(near, p)) std::swap(near, far);
    if (bound(near, p) < best_) visit(near, p);
    if (bound(far, p) < best_) visit(far, p);
  }

  void try_triangle(int t, const Vec3& p) {
    const auto [a, b, c] = triangle_corners(mesh_, mesh_.triangles[t]);
    const Vec3 point = closest_on_triangle(p, a, b, c).point;
    const double found = (point - p).squaredNorm();
    if (found >= best_) return;
    best_ = found;
    point_ = point;
  }

  const TriangleMesh& mesh_;
  BoundingTree tree_;
  double best_ = 0;
  Vec3 point_ = Vec3::Zero();
};

}  // namespace

double deviation(const TriangleMesh& mesh, const TriangleMesh& other) {
  ClosestPoint closest(other);
  double largest = 0;
  const auto look = [&](const Vec3& p) { largest = std::max(largest, (closest(p) - p).norm()); };
  for (const Triangle& t : mesh.triangles) {
    for (int v : t) look(mesh.vertices[v]);
    look(triangle_centroid(mesh, t));
  }
  return largest;
}

double distance_between(const TriangleMesh& a, const TriangleMesh& b) {
  return std::max(deviation(a, b), deviation(b, a));
}

Approach closest_approach(const TriangleMesh& mesh, const TriangleMesh& other) {
  ClosestPoint closest(other);
  Approach best;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles)
    for (int v : t) {
      const Vec3 to = closest(mesh.vertices[v]);
      const double distance = (to - mesh.vertices[v]).norm();
      if (distance >= least) continue;
      least = distance;
      best = {mesh.vertices[v], to};
    }
  return best;
}

}  // namespace bem
