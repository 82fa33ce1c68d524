#pragma once

#include "base/material.hpp"
#include "mesh/triangle_mesh.hpp"

namespace bem {

/// Collocation matrices of the boundary integral equation (M1) at one Laplace parameter s, for N
/// vertices with the origin at the centre of mass: H(s) u = G(s) p + D(s) (a - g') + Q(s) alpha +
/// C(s) b.
struct LaplaceMatrices {
  Eigen::MatrixXcd h, g;  ///< 3N x 3N
  Eigen::MatrixXcd d, q;  ///< 3N x 3
  Eigen::MatrixXcd c;     ///< 3N x 6: the body force rho B y by the entries b of B (M7)
};

/// Reference path: scalar complex double kernels, one point at a time. O(N^2) and slow; the fast
/// path (RowAssembler) is held against it. Own blocks are evaluated directly, without the
/// translation identity.
LaplaceMatrices laplace_matrices(const TriangleMesh& mesh, const Material& material, Complex s,
                                 double quadrature_tolerance);

/// int u*(x_i, y) p(y) dGamma for tractions given at the three corners of every triangle [Pa]
/// (discontinuous between triangles): a vector of 3N.
Eigen::VectorXcd laplace_corner_load(const TriangleMesh& mesh, const Material& material, Complex s,
                                     double quadrature_tolerance,
                                     const std::vector<std::array<Eigen::Vector3cd, 3>>& tractions);

}  // namespace bem
