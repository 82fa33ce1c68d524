#pragma once

#include "mesh/triangle_mesh.hpp"

#include <utility>
#include <vector>

namespace bem {

/// The closed fans of triangles around the vertices of a closed manifold mesh.
class VertexFans {
 public:
  explicit VertexFans(const TriangleMesh& mesh);

  /// Triangles that contain a vertex.
  const std::vector<int>& triangles(int vertex) const { return triangles_[vertex]; }
  /// Neighbours of a vertex, counter-clockwise seen from outside.
  std::vector<int> ring(int vertex) const;

  /// What H holds of row `vertex` beyond quadrature: free term plus the analytic static part of the
  /// traction kernel on the fan, as (column vertex, 3x3 block); a column may occur several times.
  /// (M33), (M35)-(M37)
  std::vector<std::pair<int, Mat3>> static_blocks(int vertex, double kappa) const;

 private:
  const TriangleMesh& mesh_;
  std::vector<std::vector<int>> triangles_;
};

}  // namespace bem
