#pragma once

#include "base/types.hpp"

#include <cmath>
#include <vector>

namespace bem {

/// Axis-aligned box [m].
struct BoundingBox {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  Vec3 centre() const { return 0.5 * (min + max); }
  double diagonal() const { return (max - min).norm(); }
};

/// Smallest box around the points; the box of no points is the origin. O(n).
inline BoundingBox bounding_box(const std::vector<Vec3>& points) {
  BoundingBox box;
  if (points.empty()) return box;
  box.min = box.max = points.front();
  for (const Vec3& p : points) {
    box.min = box.min.cwiseMin(p);
    box.max = box.max.cwiseMax(p);
  }
  return box;
}

/// Makes the box the smallest one around itself and the other.
inline void extend(BoundingBox& box, const BoundingBox& other) {
  box.min = box.min.cwiseMin(other.min);
  box.max = box.max.cwiseMax(other.max);
}

/// The box with every side moved outward by `margin` [m].
inline BoundingBox widened(const BoundingBox& box, double margin) {
  const Vec3 by = Vec3::Constant(margin);
  return {box.min - by, box.max + by};
}

/// Whether the boxes have a point in common; false if a coordinate is not a number.
inline bool overlap(const BoundingBox& a, const BoundingBox& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] && a.min[1] <= b.max[1] &&
         b.min[1] <= a.max[1] && a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

inline bool contains(const BoundingBox& outer, const BoundingBox& inner) {
  return (outer.min.array() <= inner.min.array()).all() &&
         (inner.max.array() <= outer.max.array()).all();
}

/// Square of the distance between the closest points of the boxes [m^2], 0 if they overlap.
inline double squared_distance(const BoundingBox& a, const BoundingBox& b) {
  return (a.min - b.max).cwiseMax(b.min - a.max).cwiseMax(0.0).squaredNorm();
}

/// Distance between the closest points of the boxes [m], 0 if they overlap.
inline double distance(const BoundingBox& a, const BoundingBox& b) {
  return std::sqrt(squared_distance(a, b));
}

/// Upper bound of the distance between points of two boxes.
inline double largest_distance(const BoundingBox& a, const BoundingBox& b) {
  return (a.max - b.min).cwiseAbs().cwiseMax((b.max - a.min).cwiseAbs()).norm();
}

}  // namespace bem
