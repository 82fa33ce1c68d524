#pragma once

#include "quadrature/triangle_rules.hpp"

#include <array>

namespace bem {

/// Chooses the rule with the fewest points that integrates the kernels over a triangle to a
/// relative tolerance, from measured errors of the traction kernel at given distances, and from the
/// oscillation of the kernels over the triangle.
class RuleChoice {
 public:
  /// tolerance: relative error aimed at, clamped to [1e-11, 1e-1].
  explicit RuleChoice(double tolerance);

  /// Index into triangle_rules(), or -1: split the triangle into four and choose again.
  /// ratio: distance of the point from the triangle / longest edge.
  /// oscillation: Z = |s|_max * longest edge / c2 (0 for the static kernel).
  int choose(double ratio, double oscillation) const;

 private:
  double tolerance_;
  /// Distance ratio beyond which a rule reaches the tolerance for the static kernel.
  std::array<double, kTriangleRuleCount> smallest_ratio_;
  std::array<double, kTriangleRuleCount> largest_oscillation_;
};

}  // namespace bem
