#pragma once

#include "compress/matrix_family.hpp"

namespace bem {

// A family of one matrix, or of the real and the imaginary part of one, times complex vectors,
// which are columns. Parts of vectors that are zero cost nothing.

/// A v.
Eigen::MatrixXcd multiply_complex(const MatrixFamily& family, const Eigen::MatrixXcd& v);
/// A^T v (not conjugated).
Eigen::MatrixXcd multiply_complex_transposed(const MatrixFamily& family, const Eigen::MatrixXcd& v);
/// The same for the first, real matrix of a family and real vectors.
Eigen::MatrixXd multiply_real(const MatrixFamily& family, const Eigen::MatrixXd& v);
Eigen::MatrixXd multiply_real_transposed(const MatrixFamily& family, const Eigen::MatrixXd& v);

/// Real and imaginary parts, side by side, and back.
Eigen::MatrixXd parts_of(const Eigen::MatrixXcd& v);
Eigen::MatrixXcd from_parts(const Eigen::MatrixXd& parts);

/// A v for a v that has entries in some rows only: `values` holds these.
Eigen::VectorXcd multiply_complex_sparse(const MatrixFamily& family,
                                         const std::vector<int>& columns,
                                         const Eigen::VectorXcd& values);

/// Entries at the crossings of some rows and columns.
Eigen::MatrixXcd complex_block(const MatrixFamily& family, const std::vector<int>& rows,
                               const std::vector<int>& columns);

}  // namespace bem
