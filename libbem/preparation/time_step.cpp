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

double median_edge(const TriangleMesh& mesh) {
  std::vector<double> lengths;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      lengths.push_back((mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

}  // namespace

WaveTimes wave_times(const TriangleMesh& mesh, double extent, const Material& material) {
  const double speed = material.shear_speed();
  return {median_edge(mesh) / speed, extent / speed};
}

double automatic_time_step(const std::vector<WaveTimes>& bodies,
                           std::optional<double> frame_interval) {
  constexpr double kLongest = 0.02, kNoBodies = 0.01;         // [s]
  constexpr double kStepsOfImpact = 8, kExpensiveSteps = 30;  // while a shear wave crosses a body
  double step = bodies.empty() ? kNoBodies : kLongest;
  for (const WaveTimes& body : bodies)
    step = std::min({step, body.edge, body.extent / kStepsOfImpact});
  double least = 0;
  for (const WaveTimes& body : bodies) least = std::max(least, body.extent / kExpensiveSteps);
  step = std::max(step, std::min(least, kLongest));
  if (!frame_interval) return round_down(step);
  return *frame_interval / std::ceil(*frame_interval / step * (1 - 1e-12));
}

}  // namespace bem
