#pragma once

#include "compress/matrix_family.hpp"

namespace bem {

// A family of one matrix, or of the real and the imaginary part of one, times complex vectors,
// which are columns. Parts of vectors that are zero cost nothing.

/// A v.
Eigen::MatrixXcd multiply_complex(const MatrixFamily& family, const Eigen::MatrixXcd& v);

/// A^T v (not conjugated).
Eigen::MatrixXcd multiply_complex_transposed(const MatrixFamily& family, const Eigen::MatrixXcd& v);

/// A v for a v that has entries in some rows only: `values` holds these.
Eigen::VectorXcd multiply_complex_sparse(const MatrixFamily& family,
                                         const std::vector<int>& columns,
                                         const Eigen::VectorXcd& values);

/// Entries at the crossings of some rows and columns.
Eigen::MatrixXcd complex_block(const MatrixFamily& family, const std::vector<int>& rows,
                               const std::vector<int>& columns);

}  // namespace bem
