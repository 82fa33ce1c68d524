#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <vector>

#include <Eigen/SparseCore>

namespace bem {

/// Shape functions of a triangle: the hats of its vertices and the bubbles of its edges.
inline constexpr int kShapes = 6;

/// The edges of a closed mesh.
struct MeshEdges {
  explicit MeshEdges(const std::vector<Triangle>& triangles);

  std::vector<std::array<int, 2>> vertices;  ///< of every edge, the smaller one first
  std::vector<std::array<int, 3>> of;        ///< by triangle: edge k runs from corner k to k + 1

  std::size_t size() const { return vertices.size(); }
};

/// Displacements that are quadratic along edges without unknowns of their own: the field of vertex
/// values u_j is u = sum_j L_j u_j + sum_e 4 L_a L_b beta_e with beta_e = sum_j rho_ej u_j for
/// every edge e = (a, b). The coefficients rho depend on the mesh alone; they come from a
/// least-squares fit of a quadratic to the values at the vertices around the edge, whose linear
/// part is taken out first, so that rigid motions and uniform strain have no bubbles on any mesh.
class EdgeReconstruction {
 public:
  /// The mesh is closed. O(n).
  explicit EdgeReconstruction(const TriangleMesh& mesh);

  const MeshEdges& edges() const { return edges_; }
  /// rho: edges x vertices.
  const Eigen::SparseMatrix<double, Eigen::RowMajor>& coefficients() const { return rho_; }

 private:
  MeshEdges edges_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> rho_;
};

/// The vertices whose basis functions phi~_j = L_j + sum_e rho_ej 4 L_a L_b do not vanish on a
/// triangle, and their values as combinations of its six shape functions L_0, L_1, L_2, 4 L_0 L_1,
/// 4 L_1 L_2, 4 L_2 L_0.
struct TriangleBasis {
  std::vector<int> vertices;                   ///< ascending
  std::vector<std::array<double, 6>> weights;  ///< by vertex
};
TriangleBasis triangle_basis(const TriangleMesh& mesh, const EdgeReconstruction& reconstruction,
                             int triangle);

/// Values of the six shape functions at barycentric coordinates.
inline std::array<double, 6> quadratic_shapes(const double* l) {
  return {l[0], l[1], l[2], 4 * l[0] * l[1], 4 * l[1] * l[2], 4 * l[2] * l[0]};
}

}  // namespace bem
