#pragma once

#include "collision/moving_surface.hpp"
#include "mesh/bounding_tree.hpp"

#include <optional>

namespace bem {

/// A surface in a step with the boxes of what its parts sweep, widened by half the distance at
/// which surfaces see each other. The boxes of its tree are wider still, by a slack: they, and the
/// pairs of triangles found with them, hold until a vertex leaves them.
class SweptSurface {
 public:
  explicit SweptSurface(SurfaceTopology topology);

  /// Takes a motion, whose places are copied. `reach` is the distance of seeing [m]. O(n).
  void sweep(const std::vector<Vec3>& start, const std::vector<Vec3>& end, double reach);
  /// Brings what a search for pairs needs up to date: tree, normals, ridges. O(n).
  void prepare();

  const SurfaceTopology& topology() const { return topology_; }
  const BoundingTree& tree() const { return *tree_; }
  /// Box of what the whole surface sweeps, and the same with slack.
  const BoundingBox& swept_box() const { return swept_box_; }
  const BoundingBox& box() const { return box_; }
  /// Changes whenever the boxes of the tree do.
  long boxes_version() const { return boxes_version_; }
  /// Changes whenever a vertex is elsewhere at the start or end than in the motion before.
  long motion_version() const { return motion_version_; }

  MovingSurface moving(int index) const;
  const BoundingBox& vertex_box(int v) const { return vertex_boxes_[v]; }
  BoundingBox triangle_box(int t) const;
  BoundingBox edge_box(int e) const;
  /// Is the edge convex at the start or the end of the step?
  bool is_ridge(int e) const { return ridges_[e] != 0; }

 private:
  bool is_within_slack() const;
  void find_ridges();

  SurfaceTopology topology_;
  std::vector<Vec3> start_, end_;
  double reach_ = 0;  ///< [m]
  std::vector<BoundingBox> vertex_boxes_, wide_boxes_;
  BoundingBox swept_box_, box_;
  std::optional<BoundingTree> tree_;
  SurfaceNormals normals_;
  std::vector<char> ridges_;
  long boxes_version_ = 0, motion_version_ = 0;
  long tree_version_ = -1, normals_version_ = -1;  ///< of boxes and motion that they are of
};

}  // namespace bem
