#pragma once

#include "base/types.hpp"

namespace bem {

/// A point of the rule of degree 2 on a surface: the midpoint of an edge, which triangles share.
struct Midpoint {
  Vec3 place = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< times the area [m^2]
  double area = 0;             ///< that the point stands for [m^2]
  double reach = 0;            ///< see leaves_out() [m]

  Midpoint() = default;
  /// Of the edge (a, b), without an area.
  Midpoint(const Vec3& a, const Vec3& b);
};

/// Whether the rule leaves out two points, which are closer than a quarter of an edge or the same:
/// kernels are nearly singular there. Triangles with such points are integrated by other rules.
bool leaves_out(const Midpoint& x, const Midpoint& y);

}  // namespace bem
