#pragma once

#include "base/types.hpp"

#include <vector>

// Motions of a scene as they are written in the scene file; units as in scene.hpp.

namespace bem {

/// Rotation by `angle` [rad], of any size and sign, about the unit vector `axis`.
struct AxisAngle {
  Vec3 axis = Vec3::UnitX();
  double angle = 0;

  Mat3 matrix() const;
};

/// One point of a factor over time.
struct ProfilePoint {
  double time = 0;  ///< [s]
  double factor = 0;
};

/// Factor over time, with increasing times (profile_value evaluates it); empty is the factor 1.
using Profile = std::vector<ProfilePoint>;

/// Where a motion has brought things at one time (motion_at interpolates).
struct Keyframe {
  double time = 0;                ///< [s]
  Vec3 translate = Vec3::Zero();  ///< [m]
  AxisAngle rotate;
  Vec3 about = Vec3::Zero();  ///< centre of the rotation [m]
};

/// Keyframes with increasing times; empty is no motion.
using Motion = std::vector<Keyframe>;

}  // namespace bem
