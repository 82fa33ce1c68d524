#pragma once

#include "base/types.hpp"

namespace bem {

/// A normal of a point.
struct PointNormal {
  int point;       ///< its index, -1 for a normal that nothing has
  Vec3 direction;  ///< of any length, also zero
};

}  // namespace bem
