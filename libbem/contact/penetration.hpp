#pragma once

#include "contact/bounding_tree.hpp"
#include "contact/collision_detector.hpp"
#include "contact/surface_topology.hpp"

namespace bem {

/// The deepest penetration found, and where.
struct Penetration {
  double depth = 0;  ///< [m], 0 if nothing penetrates
  int vertex = -1;   ///< the deepest vertex, -1 if nothing penetrates
};

/// A surface of m triangles that points may be in, prepared for many questions in O(m log m).
class PenetrableSurface {
 public:
  /// The vertices are copied.
  PenetrableSurface(const std::vector<Triangle>& triangles, std::vector<Vec3> vertices);

  bool is_closed() const { return closed_; }
  /// Deepest of the `points` inside the surface: its distance to the nearest triangle. Inside is
  /// what that triangle's pseudonormal and, for a closed surface, the winding number say. O(n + k
  /// log m) for n points of which k are in the surface's box, and O(m) for every point that is
  /// deeper than those before.
  Penetration deepest(const std::vector<Vec3>& points) const;

 private:
  std::vector<Vec3> vertices_;
  SurfaceTopology topology_;
  BoundingTree tree_;
  bool closed_;
};

/// The same for a single question.
Penetration deepest_penetration(const std::vector<Vec3>& points,
                                const std::vector<Triangle>& triangles,
                                const std::vector<Vec3>& vertices);

/// Deepest of the points below the plane. O(n).
Penetration deepest_penetration(const std::vector<Vec3>& points, const CollisionPlane& plane);

}  // namespace bem
