#include "assembly/galerkin_combination.hpp"

namespace bem {
namespace {

/// Lanes of a function of d = s dt.
std::vector<double> lanes_of(const Scheme& scheme, const LaneLayout& layout,
                             const std::function<Complex(Complex)>& f) {
  std::vector<double> lanes(layout.count());
  ContourQuadrature(scheme, layout.last_lag)
      .weights(
          1, [&f](Complex d, Complex* value) { *value = f(d); }, lanes.data(), true);
  return lanes;
}

}  // namespace

GalerkinCombination::GalerkinCombination(const Discretisation& d, const LaneLayout& layout)
    : inertial_(d.scheme, layout, {0, 0, 1}),
      damped_(d.scheme, layout, {1, d.damping.time / d.dt, 0}),
      initial_(layout.initial),
      one_(lanes_of(d.scheme, layout, [](Complex) { return 1.0; })),
      softened_(
          lanes_of(d.scheme, layout,
                   [time = d.damping.time / d.dt](Complex s) { return 1.0 / (1.0 + time * s); })),
      h_scale_(1 / (d.dt * d.dt)) {
  const double way = d.material.shear_speed() * d.dt;
  g_scale_ = -1 / (way * way);
}

}  // namespace bem
