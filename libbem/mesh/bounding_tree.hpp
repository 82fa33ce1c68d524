#pragma once

#include "mesh/bounding_box.hpp"

#include <utility>
#include <vector>

namespace bem {

/// Binary tree of axis-aligned boxes over the triangles of a mesh, or over other things that have
/// boxes, halved by the longest axis of their centres. Built once; moving vertices refit the boxes
/// and leave the tree as it is.
class BoundingTree {
 public:
  struct Node {
    BoundingBox box;
    int begin, end;  ///< range in order()
    int right;       ///< second child, the first follows its parent; -1 in a leaf

    bool leaf() const { return right < 0; }
  };

  /// Boxes are those of the positions. O(n log n).
  BoundingTree(const std::vector<Triangle>& triangles, const std::vector<Vec3>& positions);
  /// A tree over the boxes themselves. O(n log n).
  explicit BoundingTree(const std::vector<BoundingBox>& boxes);

  /// New boxes from those of the vertices. O(n).
  void refit(const std::vector<Triangle>& triangles, const std::vector<BoundingBox>& vertex_boxes);

  const std::vector<Node>& nodes() const { return nodes_; }
  /// Triangles (or whatever has the boxes) in the order of the leaves, and their boxes.
  const std::vector<int>& order() const { return order_; }
  const std::vector<BoundingBox>& boxes() const { return boxes_; }

 private:
  void build(const std::vector<Vec3>& centroids);
  int build(const std::vector<Vec3>& centroids, int begin, int end);
  void refit_nodes();

  std::vector<Node> nodes_;
  std::vector<int> order_;
  std::vector<BoundingBox> boxes_;
};

/// Calls visit(s, t) for all triangles s below node p of `a` and t below node q of `b` whose boxes
/// overlap, in a fixed order.
template <typename Visit>
void visit_overlaps(const BoundingTree& a, int p, const BoundingTree& b, int q, Visit& visit) {
  const BoundingTree::Node& m = a.nodes()[p];
  const BoundingTree::Node& n = b.nodes()[q];
  if (!overlap(m.box, n.box)) return;
  if (m.leaf() && n.leaf()) {
    for (int i = m.begin; i < m.end; ++i)
      for (int j = n.begin; j < n.end; ++j)
        if (overlap(a.boxes()[i], b.boxes()[j])) visit(a.order()[i], b.order()[j]);
  } else if (n.leaf() || (!m.leaf() && m.end - m.begin >= n.end - n.begin)) {
    visit_overlaps(a, p + 1, b, q, visit);
    visit_overlaps(a, m.right, b, q, visit);
  } else {
    visit_overlaps(a, p, b, q + 1, visit);
    visit_overlaps(a, p, b, n.right, visit);
  }
}

/// The same for the pairs of different triangles below node p of one tree, each pair once.
template <typename Visit>
void visit_self_overlaps(const BoundingTree& tree, int p, Visit& visit) {
  const BoundingTree::Node& n = tree.nodes()[p];
  if (n.leaf()) {
    for (int i = n.begin; i < n.end; ++i)
      for (int j = i + 1; j < n.end; ++j)
        if (overlap(tree.boxes()[i], tree.boxes()[j])) visit(tree.order()[i], tree.order()[j]);
  } else {
    visit_self_overlaps(tree, p + 1, visit);
    visit_self_overlaps(tree, n.right, visit);
    visit_overlaps(tree, p + 1, tree, n.right, visit);
  }
}

/// Calls visit(t) for all triangles t below node `index` that are in leaves nearer to p than
/// the square root of `nearest` [m^2], which visit() may lower. Near ones mostly come first.
template <typename Visit>
void visit_near(const BoundingTree& tree, int index, const Vec3& p, const double& nearest,
                Visit& visit) {
  const BoundingTree::Node& node = tree.nodes()[index];
  const auto distance2 = [&](int i) { return squared_distance({p, p}, tree.nodes()[i].box); };
  if (distance2(index) >= nearest) return;
  if (node.leaf()) {
    for (int i = node.begin; i < node.end; ++i) visit(tree.order()[i]);
    return;
  }
  const int first = index + 1;
  const bool ahead = distance2(first) <= distance2(node.right);
  visit_near(tree, ahead ? first : node.right, p, nearest, visit);
  visit_near(tree, ahead ? node.right : first, p, nearest, visit);
}

/// The pairs of boxes that overlap, first < second, sorted. O((n + pairs) log n), wherever they
/// are.
std::vector<std::pair<int, int>> overlapping_pairs(const std::vector<BoundingBox>& boxes);

}  // namespace bem
