#include "mesh/bounding_tree.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

constexpr int kLeafSize = 4;

}  // namespace

BoundingTree::BoundingTree(const std::vector<Triangle>& triangles,
                           const std::vector<Vec3>& positions)
    : order_(triangles.size()), boxes_(triangles.size()) {
  std::vector<Vec3> centroids(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    centroids[t] =
        (positions[triangles[t][0]] + positions[triangles[t][1]] + positions[triangles[t][2]]) /
        3.0;
  build(centroids);
  std::vector<BoundingBox> vertex_boxes(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) vertex_boxes[v] = {positions[v], positions[v]};
  refit(triangles, vertex_boxes);
}

BoundingTree::BoundingTree(const std::vector<BoundingBox>& boxes)
    : order_(boxes.size()), boxes_(boxes.size()) {
  std::vector<Vec3> centres;
  centres.reserve(boxes.size());
  for (const BoundingBox& box : boxes) {
    const Vec3 centre = box.centre();
    // boxes without a place overlap nothing, but must not upset the order of the others
    centres.push_back(centre.allFinite() ? centre : Vec3(Vec3::Zero()));
  }
  build(centres);
  for (std::size_t i = 0; i < order_.size(); ++i) boxes_[i] = boxes[order_[i]];
  refit_nodes();
}

void BoundingTree::build(const std::vector<Vec3>& centroids) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!order_.empty()) build(centroids, 0, static_cast<int>(order_.size()));
}

int BoundingTree::build(const std::vector<Vec3>& centroids, int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, begin, end, -1});
  if (end - begin <= kLeafSize) return index;
  BoundingBox centres{centroids[order_[begin]], centroids[order_[begin]]};
  for (int i = begin + 1; i < end; ++i)
    extend(centres, {centroids[order_[i]], centroids[order_[i]]});
  int axis = 0;
  (centres.max - centres.min).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) {
                     const double ca = centroids[a][axis], cb = centroids[b][axis];
                     return ca != cb ? ca < cb : a < b;
                   });
  build(centroids, begin, middle);
  const int right = build(centroids, middle, end);
  nodes_[index].right = right;
  return index;
}

void BoundingTree::refit(const std::vector<Triangle>& triangles,
                         const std::vector<BoundingBox>& vertex_boxes) {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Triangle& t = triangles[order_[i]];
    boxes_[i] = vertex_boxes[t[0]];
    extend(boxes_[i], vertex_boxes[t[1]]);
    extend(boxes_[i], vertex_boxes[t[2]]);
  }
  refit_nodes();
}

void BoundingTree::refit_nodes() {
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    if (node.leaf()) {
      node.box = boxes_[node.begin];
      for (int k = node.begin + 1; k < node.end; ++k) extend(node.box, boxes_[k]);
    } else {
      node.box = nodes_[i + 1].box;
      extend(node.box, nodes_[node.right].box);
    }
  }
}

std::vector<std::pair<int, int>> overlapping_pairs(const std::vector<BoundingBox>& boxes) {
  std::vector<std::pair<int, int>> pairs;
  if (boxes.empty()) return pairs;
  const BoundingTree tree(boxes);
  auto add = [&](int a, int b) { pairs.emplace_back(std::min(a, b), std::max(a, b)); };
  visit_self_overlaps(tree, 0, add);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace bem
