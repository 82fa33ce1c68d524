#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Unilateral contact with Coulomb friction at n points: find r with, for every contact,
///
///     u = W r + q,   0 <= u_n, 0 <= r_n, u_n r_n = 0,   |r_t| <= mu r_n,
///     r_t = -mu r_n u_t / |u_t| where u_t is not zero.
///
/// Every contact has three components (normal, t1, t2). Here u is the relative displacement at the
/// end of a time step [m], r the force [N], W the compliance [m/N] and q the displacement without
/// contact forces [m]; any other consistent units will do, whatever their magnitudes.
///
/// W is given as rows of 3x3 blocks and need not be symmetric nor regular. Contacts without a block
/// do not act on each other.
struct FrictionProblem {
  std::vector<int> row_start{0};  ///< n + 1: blocks of contact i are [row_start[i], row_start[i+1])
  std::vector<int> columns;       ///< per block the contact whose force acts; ascending in a row,
                                  ///< with the contact itself in its own row
  std::vector<Mat3> blocks;       ///< per block d u_i / d r_j
  Eigen::VectorXd q;              ///< 3n
  Eigen::VectorXd mu;             ///< n friction coefficients >= 0

  int contacts() const { return static_cast<int>(mu.size()); }
};

/// Checks the sizes, the order of the columns and the signs of mu; throws ErrorCode::internal.
void check_problem(const FrictionProblem& problem);

}  // namespace bem
