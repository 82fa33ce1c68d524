#pragma once

#include "compress/family_builder.hpp"
#include "compress/layered_matrix.hpp"

namespace bem {

/// A block of several matrices X_k (m x n) with common bases, X_k = Q C_k P^T. The columns of Q and
/// P are orthonormal and roughly sorted by what they carry: sigma_i^2 = sum_k |row i of C_k|^2 for
/// Q, the same with columns for P.
struct BlockFactors {
  FloatMatrix output_basis;           ///< Q, m x p
  FloatMatrix input_basis;            ///< P, n x r
  Eigen::VectorXf output_weights;     ///< sigma of Q
  Eigen::VectorXf input_weights;      ///< sigma of P
  std::vector<FloatMatrix> coupling;  ///< C_k, p x r
  double squared_error = 0;           ///< sum_k |X_k - Q C_k P^T|^2, estimated
  double squared_norm = 0;            ///< sum_k |X_k|^2, of blocks in factors
};

/// Finds the bases from Gram matrices, of large blocks after a projection that products with random
/// vectors give (Halko, Martinsson & Tropp 2011; the vectors are the same for every block), and
/// leaves out directions that carry less than about `least`. About m n K (min(m, 240) + p + r)
/// multiply-adds.
BlockFactors factor_block(const std::vector<MatrixView<float>>& matrices, double least);

/// The same of a block that is in factors already.
BlockFactors factor_block(const FactoredBlock& block, double least);

}  // namespace bem
