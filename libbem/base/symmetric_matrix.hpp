#pragma once

#include "base/types.hpp"

namespace bem {

/// Symmetric 3x3 matrices by six numbers: xx xy xz yy yz zz, off-diagonal ones for both entries.
inline Mat3 symmetric_matrix(const Vector6& b) {
  Mat3 m;
  m << b[0], b[1], b[2], b[1], b[3], b[4], b[2], b[4], b[5];
  return m;
}

/// The six numbers of a symmetric matrix.
inline Vector6 symmetric_entries(const Mat3& m) {
  Vector6 b;
  b << m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2);
  return b;
}

/// B x by the six numbers of B: column e is symmetric_matrix(unit vector e) * x.
inline Eigen::Matrix<double, 3, 6> symmetric_products(const Vec3& x) {
  Eigen::Matrix<double, 3, 6> columns;
  for (int e = 0; e < 6; ++e) columns.col(e) = symmetric_matrix(Vector6::Unit(e)) * x;
  return columns;
}

}  // namespace bem
