#pragma once

#include "assembly/edge_reconstruction.hpp"
#include "support/laplace_assembly.hpp"

namespace bem {

/// Galerkin matrices at one Laplace parameter s, in the same form as those of collocation: H(s) u =
/// G(s) p + D(s) (a - g') + Q(s) alpha + C(s) b, where H is the hypersingular operator tested and
/// tried with phi~ of the edge reconstruction, G_aj = <phi~_a, (1/2 - K'(s)) psi_j> with linear
/// psi_j, and [D Q] = -Z(s) R; the mesh has its origin at the centre of mass. Entries of H have the
/// unit Pa m, of G m^2.
///
/// Reference path: scalar complex double kernels, one pair of points at a time; the fast path is
/// held against it. H is as it is integrated, not corrected for rotation. O(N^2) and slow.
LaplaceMatrices galerkin_laplace_matrices(const TriangleMesh& mesh,
                                          const EdgeReconstruction& reconstruction,
                                          const Material& material, Complex s,
                                          double quadrature_tolerance);

/// sum_T <phi~_a, (1/2 - K'(s)) p> for tractions given at the three corners of every triangle [Pa],
/// which may jump between triangles: a vector of 3N.
Eigen::VectorXcd galerkin_corner_load(
    const TriangleMesh& mesh, const EdgeReconstruction& reconstruction, const Material& material,
    Complex s, double quadrature_tolerance,
    const std::vector<std::array<Eigen::Vector3cd, 3>>& tractions);

/// What a pair of triangles contributes, by the six shape functions of each, unknowns 3 shape +
/// axis: to H(s) = H(0) + s^2 Z(s), whose static part has a meaning in sums over closed surfaces
/// only, and to K'(s) for linear tractions.
struct PairMatrices {
  using Shapes = Eigen::Matrix<Complex, 18, 18>;
  Eigen::Matrix<double, 18, 18> static_h;
  Shapes inertia;                         ///< Z
  Eigen::Matrix<Complex, 18, 9> adjoint;  ///< K'
  Eigen::Matrix<Complex, 18, 6> strain;  ///< the dynamic part J of K' on uniform strain's tractions
};
PairMatrices galerkin_laplace_pair(const TriangleMesh& mesh, const Material& material, Complex s,
                                   double quadrature_tolerance, int tx, int ty);

/// The surface curls n x grad of the six shape functions of a triangle at barycentric coordinates
/// [1/m].
std::array<Vec3, 6> quadratic_curls(const TriangleMesh& mesh, const Triangle& t, const double* l);

}  // namespace bem
