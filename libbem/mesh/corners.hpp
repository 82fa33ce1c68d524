#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// The fans of triangles around the vertices of a closed mesh, parted by its sharp edges.
class CornerSectors {
 public:
  /// Edges are sharp whose triangles' normals enclose more than `angle_deg`. O(n log n).
  CornerSectors(const TriangleMesh& mesh, double angle_deg);

  /// The triangles around a vertex, ascending within each sector; one sector where sharp edges do
  /// not part them.
  const std::vector<std::vector<int>>& sectors(int vertex) const { return sectors_[vertex]; }

 private:
  std::vector<std::vector<std::vector<int>>> sectors_;
};

}  // namespace bem
