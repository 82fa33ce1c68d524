#pragma once

#include "assembly/pair_quadrature.hpp"

namespace bem {

/// Blocks of a pair of triangles by the six shape functions of each, unknowns 3 shape + axis.
using PairMatrix = Eigen::Matrix<double, 18, 18>;
using PairTractions = Eigen::Matrix<double, 18, 9>;  ///< columns: linear shape functions

/// Adds the static parts of a pair: D(0) [Pa m], which has a meaning in sums over closed surfaces
/// only, and K'(0) [m^2]. `h` may be null.
void add_static_pair(const PairQuadrature& quadrature, double shear_modulus, double kappa, int tx,
                     int ty, PairMatrix* h, PairTractions& adjoint);

/// int phi_i L_j over a triangle of that area [m^2].
PairTractions mass_matrix(double area);

}  // namespace bem
