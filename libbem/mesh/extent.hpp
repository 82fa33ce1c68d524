#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Largest distance between two of the points [m], exact; 0 for fewer than two. Finite coordinates
/// required.
///
/// Branch and bound over pairs of cells of a tree. Spheres are the hard case, because nearly every
/// point has a partner at nearly the largest distance: a second bound, by the angle between two
/// cells seen from the common centre, keeps it at O(n log n) there too (0.2 s for 160,000 points).
double diameter(const std::vector<Vec3>& points);

}  // namespace bem
