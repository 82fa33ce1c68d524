#include "preparation/time_step.hpp"

#include "mesh/describe.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// The next smaller number with one digit, or a one or two with a half or a quarter behind it.
double round_down(double value) {
  constexpr double kRounded[] = {8, 6, 5, 4, 3, 2.5, 2, 1.5, 1.25, 1};
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double digits : kRounded)
    if (digits * power <= value * (1 + 1e-12)) return digits * power;
  return power;
}

/// Before it is rounded.
AutomaticTimeStep longest_step(const std::vector<double>& crossings) {
  constexpr double kLongest = 0.02, kNoBodies = 0.01;  // [s]
  constexpr double kSteps = 8, kMostSteps = 30;        // of a crossing
  if (crossings.empty()) return {kNoBodies, ", because no body deforms"};
  const auto [least, most] = std::minmax_element(crossings.begin(), crossings.end());
  const double fast = *least / kSteps, slow = *most / kMostSteps;
  if (std::max(fast, slow) > kLongest) return {kLongest, ", the longest that is chosen by itself"};
  if (slow > fast)
    return {slow,
            ", in at least thirty of which a shear wave crosses the body that it crosses slowest"};
  return {fast, std::string(", in at least eight of which a shear wave crosses the body") +
                    (crossings.size() > 1 ? " that it crosses fastest" : "")};
}

}  // namespace

double crossing_time(double extent, const Material& material) {
  return extent / material.shear_speed();
}

AutomaticTimeStep automatic_time_step(const std::vector<double>& crossings,
                                      std::optional<double> frame_interval) {
  AutomaticTimeStep step = longest_step(crossings);
  if (!frame_interval) {
    step.seconds = round_down(step.seconds);
    return step;
  }
  const double steps = std::ceil(*frame_interval / step.seconds * (1 - 1e-12));
  step.seconds = *frame_interval / steps;
  if (steps > 1)
    step.reason += "; " + to_text(steps) + " of them lead from one frame to the next";
  else
    step.reason = ", as it is from one frame to the next";
  return step;
}

}  // namespace bem
