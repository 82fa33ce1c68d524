#include "quadrature/rule_choice.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kColumns = 13;

// Distance of the point from the triangle, in units of the longest edge.
constexpr double kRatios[kColumns] = {0.25, 0.35, 0.5, 0.7, 1, 1.4, 2, 2.8, 4, 5.6, 8, 11, 16};

// Largest relative error of the static traction kernel times a shape function over equilateral,
// right and 1:4 obtuse triangles and 15 positions per distance. docs/method.md, "Regular
// integrals".
constexpr double kErrors[kTriangleRuleCount][kColumns] = {
    {1e0, 7e-1, 5e-1, 4e-1, 3e-1, 2e-1, 2e-1, 1e-1, 8e-2, 6e-2, 4e-2, 3e-2, 2e-2},
    {5e-1, 3e-1, 2e-1, 7e-2, 3e-2, 1e-2, 6e-3, 3e-3, 1e-3, 7e-4, 3e-4, 2e-4, 1e-4},
    {2e-1, 1e-1, 3e-2, 1e-2, 2e-3, 6e-4, 2e-4, 4e-5, 1e-5, 4e-6, 7e-7, 2e-7, 8e-8},
    {2e-1, 9e-2, 3e-2, 9e-3, 2e-3, 4e-4, 7e-5, 1e-5, 2e-6, 5e-7, 8e-8, 1e-8, 3e-9},
    {7e-2, 2e-2, 5e-3, 9e-4, 1e-4, 2e-5, 2e-6, 2e-7, 2e-8, 2e-9, 3e-10, 4e-11, 5e-12},
    {4e-2, 9e-3, 1e-3, 2e-4, 2e-5, 1e-6, 2e-7, 2e-8, 2e-9, 1e-10, 3e-12, 2e-13, 1e-14},
    {1e-2, 2e-3, 2e-4, 1e-5, 6e-7, 2e-8, 9e-10, 3e-11, 1e-12, 4e-14, 1e-15, 1e-16, 1e-17},
    {5e-3, 6e-4, 4e-5, 2e-6, 4e-8, 7e-10, 1e-11, 3e-13, 8e-15, 1e-16, 1e-17, 1e-18, 1e-19}};

// Error at Z = 8 that the oscillation leaves at all distances; it falls about as Z^degree.
constexpr double kOscillationError[kTriangleRuleCount] = {1,    5e-2, 3e-3, 3e-3,
                                                          5e-5, 4e-6, 5e-8, 1e-9};
constexpr double kOscillationReference = 8;

double ratio_for_tolerance(const double* errors, double tolerance) {
  if (tolerance >= errors[0]) return kRatios[0];
  for (int c = 1; c < kColumns; ++c)
    if (tolerance >= errors[c]) {
      const double fraction =
          std::log(errors[c - 1] / tolerance) / std::log(errors[c - 1] / errors[c]);
      return kRatios[c - 1] * std::pow(kRatios[c] / kRatios[c - 1], fraction);
    }
  // beyond the table the error goes on falling with the slope of its last octave
  const double slope = std::log(errors[kColumns - 3] / errors[kColumns - 1]) /
                       std::log(kRatios[kColumns - 1] / kRatios[kColumns - 3]);
  return kRatios[kColumns - 1] * std::pow(errors[kColumns - 1] / tolerance, 1 / slope);
}

}  // namespace

RuleChoice::RuleChoice(double tolerance) : tolerance_(std::clamp(tolerance, 1e-11, 1e-1)) {
  for (int i = 0; i < kTriangleRuleCount; ++i) {
    smallest_ratio_[i] = ratio_for_tolerance(kErrors[i], tolerance_);
    largest_oscillation_[i] = kOscillationReference * std::pow(tolerance_ / kOscillationError[i],
                                                               1.0 / triangle_rules()[i].degree);
  }
}

int RuleChoice::choose(double ratio, double oscillation) const {
  for (int i = 0; i < kTriangleRuleCount; ++i)
    if (ratio >= smallest_ratio_[i] && (oscillation <= 1 || oscillation <= largest_oscillation_[i]))
      return i;
  return -1;
}

}  // namespace bem
