#pragma once

#include "base/types.hpp"

#include <vector>

#include <Eigen/Geometry>

namespace bem::test {

inline std::vector<Vec3> moved(std::vector<Vec3> points, const Vec3& shift,
                               const Mat3& rotation = Mat3::Identity()) {
  for (Vec3& p : points) p = rotation * p + shift;
  return points;
}

/// The rotation about an axis by an angle [rad].
inline Mat3 turned(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

}  // namespace bem::test
