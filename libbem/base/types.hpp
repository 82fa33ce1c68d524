#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

namespace bem {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Complex = std::complex<double>;
using Triangle = std::array<int, 3>;  ///< vertex indices, counter-clockwise seen from outside

inline constexpr double kPi = 3.14159265358979323846;

/// Cross-product matrix: cross_matrix(v) w = v x w.
inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return m;
}

}  // namespace bem
