#pragma once

#include "assembly/surface_patch.hpp"

namespace bem {

/// The points of the rule of degree 2 on a whole surface, the midpoints of its edges, which stand
/// for both triangles of an edge, and what functions of nodes are there. Distant parts of a surface
/// are integrated by them.
struct SurfacePoints {
  SurfacePoints(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction);

  using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  std::vector<Midpoint> points;   ///< by edge
  SparseMatrix displacements_at;  ///< nodes x points
  SparseMatrix tractions_at;      ///< nodes x points
  /// Surface curls (n x gradient) of the nodes' functions, times areas [m], by axis.
  std::array<SparseMatrix, 3> curls_at;
  /// By node: around the triangles on which its functions do not vanish, and their longest edge.
  std::vector<BoundingBox> boxes;
  std::vector<double> longest_edges;
};

/// The nodes [begin, end) of a surface, and the points that their functions reach.
struct PointCluster {
  PointCluster(const SurfacePoints& surface, int begin, int end);

  int begin = 0, end = 0;
  std::vector<int> points;                    ///< ascending; items below count in them
  SparseRows displacements_at, tractions_at;  ///< by node

  int nodes() const { return end - begin; }
};

/// Around what the functions of nodes [begin, end) do not vanish on.
struct ClusterExtent {
  ClusterExtent(const SurfacePoints& surface, int begin, int end);
  BoundingBox box;
  double longest_edge = 0;
};

}  // namespace bem
