#pragma once

#include "collision/signed_distance.hpp"

namespace bem {

/// How far two surfaces are in each other [m]: the largest depth found of a point of one surface in
/// the solid that the other bounds, or the diameter of the largest ball found in both solids; 0 if
/// they are apart, or touch with a depth of at most `tolerance` [m]. Surfaces that cross without a
/// vertex in the other, that coincide wholly or in part, and one within the other all count. What
/// is open or a sheet with two layers has no inside: only what it cuts of the other counts.
/// O(n log n), and O(n) for each point that is deeper than those before.
double surface_overlap(const SignedDistance& a, const SignedDistance& b, double tolerance);

}  // namespace bem
