#pragma once

#include "model/slab_assembly.hpp"

namespace bem {

/// Towards an incompressible material G(0) becomes singular, and volume costs infinite energy.
inline constexpr double kMostPoissonRatioOfEnergies = 0.499;

/// What the displacements u of a surface and their rates v make of the energy of the solid inside,
/// if its inside follows the surface as it does at rest (docs/method.md, "Energies"): the first
/// terms of the forces M G(s)^{-1} D(s) u of the Galerkin method in powers of s,
///   p = G(0)^{-1} D(0) u + s^2 G(0)^{-1} (Z(0) u + J(0) G(0)^{-1} D(0) u/c2^2) + ...
///   elastic energy u^T stiffness u/2, kinetic energy v^T mass v/2
/// Both matrices are symmetric, 3N x 3N. The elastic energy of uniform strain is exact on every
/// mesh. The mass of fields that zigzag on thin bodies may be negative.
struct EnergyMatrices {
  Eigen::MatrixXd stiffness;  ///< [N/m]
  Eigen::MatrixXd mass;       ///< [kg]
};

/// `discretisation`: of the Galerkin method; material (with kMostPoissonRatioOfEnergies) and
/// quadrature alone count. Bit-identical for any number of threads. Cost: O(N^3); memory:
/// energy_bytes(). Throws ErrorCode::numerical if G(0) is singular.
EnergyMatrices energy_matrices(const BodyGeometry& geometry, const Discretisation& discretisation,
                               const Progress& progress = nullptr);

/// Bytes of the largest working set of energy_matrices() for n nodes.
double energy_bytes(int n);

}  // namespace bem
