#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Interior solid angle at x [sr] of a closed simple fan of triangles (x, ring[i], ring[i+1]),
/// counter-clockwise seen from outside (M38).
double interior_solid_angle(const Vec3& x, const std::vector<Vec3>& ring);

/// Free term c(x) of the boundary integral equation at a polyhedral vertex: symmetric, I/2 where
/// the surface is smooth (M37). kappa = (c2/c1)^2.
Mat3 free_term(const Vec3& x, const std::vector<Vec3>& ring, double kappa);

}  // namespace bem
