#pragma once

#include "base/types.hpp"

namespace bem {

/// x -> translation + rotation * x.
struct RigidPlace {
  Vec3 translation = Vec3::Zero();  ///< [m]
  Mat3 rotation = Mat3::Identity();
};

}  // namespace bem
