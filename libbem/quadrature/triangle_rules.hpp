#pragma once

#include "base/types.hpp"

#include <array>

namespace bem {

struct TrianglePoint {
  double barycentric[3];
  double weight;  ///< fraction of the triangle's area
};

/// A symmetric quadrature rule on a triangle, exact for polynomials up to `degree`.
struct TriangleRule {
  int degree;
  int size;
  const TrianglePoint* points;
};

inline constexpr int kTriangleRuleCount = 8;
inline constexpr int kMaxRulePoints = 33;

/// The rules with 1, 3, 6, 7, 12, 16, 25 and 33 points (degree 1, 2, 4, 5, 6, 8, 10, 12).
const std::array<TriangleRule, kTriangleRuleCount>& triangle_rules();

}  // namespace bem
