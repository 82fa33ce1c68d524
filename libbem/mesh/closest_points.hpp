#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

/// The point of a triangle that is closest to another point.
struct NearestPoint {
  /// The feature it lies on: the smallest one.
  enum class Feature { face, edge, corner };

  Feature feature = Feature::face;
  int index = -1;                             ///< edge from corner `index` to the next, or corner
  std::array<double, 3> weights = {0, 0, 0};  ///< barycentric
  Vec3 point = Vec3::Zero();
};

NearestPoint closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Where the lines p + s (q - p) and r + u (t - r) come closest.
struct LinePair {
  double s = 0, u = 0;
  double sine = 0;  ///< of the angle between the lines; s and u mean nothing when it vanishes
};

LinePair closest_on_lines(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& t);

/// Distance of a point from a segment between two different points [m].
double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b);

/// Distance of a point from a triangle [m]. Above the face it is that from the plane, which is as
/// exact for a small distance as for a large one; the difference to closest_on_triangle() is only
/// as exact as the places are.
double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Distance of the segments from p to q and from r to t [m]; none of them is a point.
double segment_distance(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& t);

/// Distance of two triangles that do not cut through each other [m].
double triangle_distance(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace bem
