#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Signed solid angle [sr] of the triangle a, b, c as seen from p: positive if p is on the side
/// that the triangle's normal (b - a) x (c - a) points away from, at most 2 pi in size, 0 in the
/// plane of the triangle outside of it. After van Oosterom and Strackee (1983).
double solid_angle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// How often the triangles wind around p, the sum of their solid angles over 4 pi: 1 inside and 0
/// outside of a closed surface with outward normals, -1 inside one with inward normals, anything
/// between on the surface or for an open one. O(triangles).
double winding_number(const std::vector<Triangle>& triangles, const std::vector<Vec3>& vertices,
                      const Vec3& p);

}  // namespace bem
