#pragma once

#include "base/types.hpp"

namespace bem {

/// A point of the rule of degree 2 on a surface: the midpoint of an edge, which triangles share.
struct Midpoint {
  Vec3 place = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< times the area [m^2]
  double area = 0;             ///< that the point stands for [m^2]

  /// Of the edge (a, b), without an area.
  Midpoint(const Vec3& a, const Vec3& b) : place(0.5 * a + 0.5 * b) {}
};

}  // namespace bem
