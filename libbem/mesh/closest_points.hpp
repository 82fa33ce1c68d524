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

}  // namespace bem
