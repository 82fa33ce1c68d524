#pragma once

#include "mesh/two_sided.hpp"

#include <string>
#include <vector>

namespace bem {

/// Any set of triangles as something rigid that bodies touch. Parts are triangles connected by
/// edges.
struct ObstacleSurface {
  /// The parts that enclose a volume: every edge has two triangles. They face out of the material;
  /// a closed part within another is a cavity of it.
  TriangleMesh solid;
  /// All other parts: open or non-manifold ones, and those without volume. Both sides hold.
  TwoSided sheet;
  std::vector<std::string> warnings;

  std::size_t sheet_triangles() const { return sheet.layers.triangles.size() / 2; }
};

/// Welds vertices of exactly equal position, turns closed parts outward (with a warning) and leaves
/// triangles without area out of sheets (with a warning). Throws ErrorCode::invalid_input, naming
/// `source`, for indices out of range, coordinates that are not finite, and meshes without any
/// area. O(n log n), and O(n) for each pair of closed parts whose boxes overlap.
ObstacleSurface make_obstacle_surface(const TriangleMesh& input, const std::string& source);

}  // namespace bem
