#pragma once

#include "algebra/factored_matrices.hpp"
#include "base/aligned.hpp"
#include "base/types.hpp"

namespace bem {

/// Nodes [begin, end).
struct NodeRange {
  int begin = 0, end = 0;

  int size() const { return end - begin; }
};

/// Root mean square errors of entries that a FarBlock may have. Zero: what is not wanted.
struct FarErrors {
  double h = 0, initial_inertia = 0, g = 0, initial_g = 0, stiffness = 0;
};

/// The Galerkin matrices between two distant clusters of nodes, found from some of their rows.
struct FarBlock {
  NodeRange rows, columns;
  FactoredMatrices inertia;    ///< by lane: (s dt)^2 Z/dt^2 of lag 0, Z of later lags
  FactoredMatrices tractions;  ///< G by lane; zero in columns of nodes that bear no loads
  FactoredMatrices stiffness;  ///< D(0)

  /// What the block adds to the columns of body forces of its rows, and, of a symmetric matrix, of
  /// its columns: -Z R, then Z u + J p/c2^2 of uniform strain, as in GalerkinSlabs:
  /// [node][2 x 18][padded lane].
  static constexpr int kForces = 36;
  AlignedVector<double> row_forces, column_forces;
};

}  // namespace bem
