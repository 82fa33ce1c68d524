#pragma once

#include "collision/surface_topology.hpp"
#include "mesh/bounding_tree.hpp"

namespace bem {

/// Distances of points to a triangle mesh whose normals point out of what it encloses. The vertices
/// must outlive this and stay where they are.
class SignedDistance {
 public:
  /// Every edge has one or two triangles of consistent orientation. O(n log n).
  SignedDistance(const std::vector<Triangle>& triangles, const std::vector<Vec3>& vertices);

  /// Distance to the nearest triangle [m], negative on the inner side of its pseudonormal, infinite
  /// without triangles. Next to folds of a deformed surface the nearest triangle may face the wrong
  /// way: surely_contains() decides. O(log n).
  double operator()(const Vec3& p) const;
  /// Whether a closed surface goes round the point, by its winding number; true for an open one.
  /// O(n).
  bool surely_contains(const Vec3& p) const;

  const SurfaceTopology& topology() const { return topology_; }
  const std::vector<Vec3>& vertices() const { return *vertices_; }
  const BoundingTree& tree() const { return tree_; }
  /// Whether every edge has two triangles.
  bool closed() const { return closed_; }

 private:
  SurfaceTopology topology_;
  const std::vector<Vec3>* vertices_;
  BoundingTree tree_;
  bool closed_;
};

}  // namespace bem
