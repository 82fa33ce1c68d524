#pragma once

#include "base/types.hpp"

#include <vector>

namespace bem {

/// Where a range of `count` points that recursive bisection has ordered is cut: the size of its
/// first half.
inline int first_half(int count) {
  return count / 2;
}

/// Order of the points by recursive bisection: halves across the longest side of their box, those
/// again, and so on; result[k] is the index of the k-th point. Every range that first_half() leads
/// to is compact, so clusters of points are ranges of indices. Points in one place keep their
/// order. Finite coordinates required. O(n log^2 n).
std::vector<int> bisection_order(const std::vector<Vec3>& points);

}  // namespace bem
