#pragma once

#include "assembly/edge_reconstruction.hpp"
#include "assembly/midpoint.hpp"

namespace bem {

/// Linear combinations of items, row by row.
struct SparseRows {
  std::vector<int> begin = {0};  ///< of each row, and the end
  std::vector<int> items;
  std::vector<double> values;

  int rows() const { return static_cast<int>(begin.size()) - 1; }
  void add_row(const std::vector<std::pair<int, double>>& entries);
  void add_row(const SparseRows& from, int row);
  Eigen::MatrixXd dense(int item_count) const;
};

/// Some neighbouring triangles. Sums are taken by their shape functions, hats of corners and
/// bubbles of edges, or by the midpoints of their edges, and only then combined to the basis
/// functions of the nodes that reach them.
struct SurfacePatch {
  std::vector<int> triangles;
  std::vector<int> nodes;  ///< whose basis functions do not vanish here, ascending
  std::vector<int> hats;  ///< nodes that are corners here, ascending; shapes are hats, then bubbles
  int shape_count = 0;
  std::vector<std::array<int, kShapes>> shapes;  ///< by triangle: numbers of hats, then of bubbles
  SparseRows displacements;                      ///< by node: shapes

  std::vector<Midpoint> midpoints;
  SparseRows displacements_at;  ///< by node: midpoints
  SparseRows tractions_at;      ///< by hat: midpoints
  /// Surface curls (n x gradient) of the nodes' functions at midpoints, times areas [m], by axis
  /// and node: midpoints.
  std::array<SparseRows, 3> curls_at;

  BoundingBox box;
  double longest_edge = 0;
};

/// Cuts some triangles of a mesh into patches of at most so many.
std::vector<SurfacePatch> make_patches(const TriangleMesh& mesh,
                                       const EdgeReconstruction& reconstruction,
                                       const std::vector<int>& triangles, int most);

/// A patch that is cut into smaller ones.
struct PatchParts {
  struct Part {
    SurfacePatch patch;
    std::vector<int> nodes, hats;  ///< places in those of the whole patch
  };
  std::vector<Part> parts;

  /// Parts of at most so many triangles.
  PatchParts(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
             const SurfacePatch& whole, int most);
};

/// What belongs to some triangles of a patch. Box and edge remain those of the patch, so that what
/// depends on them does not depend on which triangles are asked for.
SurfacePatch part_of_patch(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                           const SurfacePatch& patch, std::vector<int> triangles);

}  // namespace bem
