#pragma once

#include "base/types.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bem {

/// Positions as whole numbers of 16 bits per axis of a box: origin + step * number. The error is at
/// most half a step, 1/131070 of the box's length along an axis.
class PositionGrid {
 public:
  static constexpr int kLevels = 65535;

  /// Of the box that holds all `points` that were added.
  void include(const std::vector<double>& points);

  const Vec3& origin() const { return least_; }
  Vec3 step() const { return (most_ - least_) / kLevels; }
  /// Points [N x 3, m] in the box.
  std::vector<std::uint16_t> quantised(const std::vector<double>& points) const;

 private:
  Vec3 least_ = Vec3::Constant(1e300), most_ = Vec3::Constant(-1e300);
};

/// Values from 0 to `most` as whole numbers of 12 bits. The error is at most most/8190.
struct ValueGrid {
  static constexpr int kLevels = 4095;
  double most = 0;

  std::vector<std::uint16_t> quantised(const std::vector<double>& values) const;
};

/// A pose as pages have it, in single precision: rotation as a quaternion (x, y, z, w).
class Pose {
 public:
  Pose() = default;
  /// Rotation matrices are row-major.
  Pose(const double* translation, const double* rotation);

  /// Points [N x 3] in the axes of the pose, so exact that only quantisation counts.
  std::vector<double> to_local(std::vector<double> points) const;
  void append_to(std::vector<float>& numbers) const;  ///< 7 numbers: translation, quaternion

 private:
  Eigen::Vector3f translation_ = Eigen::Vector3f::Zero();
  Eigen::Quaternionf rotation_ = Eigen::Quaternionf::Identity();
};

}  // namespace bem
