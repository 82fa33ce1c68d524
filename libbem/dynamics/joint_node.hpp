#pragma once

#include <vector>

namespace bem {

/// A node that fixed vertices, handles or joints act on.
struct JointNode {
  int node = 0;
  /// Held from outside by tractions spread over the surface around the node; otherwise the force
  /// acts at the point itself, so that what two bodies exert on each other cancels exactly.
  bool anchored = false;
  /// The triangles around the node that carry these tractions, ascending; none: all of them.
  std::vector<int> triangles = {};
};

}  // namespace bem
