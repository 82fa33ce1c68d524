#pragma once

#include "algebra/decompositions.hpp"

#include <vector>

namespace bem {

/// Rows of a matrix that all others are combinations of, but for a small rest: a = c c_s^{-1} a_s,
/// where a_s are the rows of the skeleton. Found by Gram-Schmidt orthogonalisation with pivots, in
/// which a = c q with orthonormal rows q and lower triangular c_s.
struct RowSkeleton {
  std::vector<int> rows;         ///< in the order in which they were chosen
  Eigen::MatrixXd coefficients;  ///< c: rows of a x size of the skeleton

  /// Ends when the squares of what is left add up to at most `cut`.
  RowSkeleton(const RealMatrix& a, double cut);

  int size() const { return static_cast<int>(rows.size()); }
  /// `combined` c_s^{-1}: what rows are of the skeleton that are `combined` = m c, or a row of c.
  Eigen::MatrixXd in_skeleton(Eigen::MatrixXd combined) const;
};

}  // namespace bem
