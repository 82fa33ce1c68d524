#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Order of the points along a 3D Hilbert curve through their bounding cube: result[k] is the index
/// of the k-th point. Points that are near in the result are near in space, which makes blocks of
/// the matrices smooth. Cells have 2^-21 of the cube's side; points of one cell keep their order.
/// Finite coordinates required. O(n log n).
std::vector<int> hilbert_order(const std::vector<Vec3>& points);

}  // namespace bem
