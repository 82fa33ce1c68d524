#include "preparation/time_step.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// The next smaller number with one digit, or a one or two with a half or a quarter behind it.
double round_down(double value) {
  constexpr double kDigits[] = {8, 6, 5, 4, 3, 2.5, 2, 1.5, 1.25, 1};
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double digits : kDigits)
    if (digits * power <= value * (1 + 1e-12)) return digits * power;
  return power;
}

}  // namespace

double crossing_time(double extent, const Material& material) {
  return extent / material.shear_speed();
}

double automatic_time_step(const std::vector<double>& crossings,
                           std::optional<double> frame_interval) {
  constexpr double kLongest = 0.02, kNoBodies = 0.01;  // [s]
  constexpr double kSteps = 8, kMostSteps = 30;        // of a crossing
  double step = crossings.empty() ? kNoBodies : kLongest, least = 0;
  for (double crossing : crossings) {
    step = std::min(step, crossing / kSteps);
    least = std::max(least, crossing / kMostSteps);
  }
  step = std::max(step, std::min(least, kLongest));
  if (!frame_interval) return round_down(step);
  return *frame_interval / std::ceil(*frame_interval / step * (1 - 1e-12));
}

}  // namespace bem
