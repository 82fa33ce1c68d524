#pragma once

#include "dynamics/body_output.hpp"
#include "support/simulate.hpp"
#include "verification/beam_modes.hpp"

#include <cstdio>

namespace bem_test {

/// A beam along x, clamped at its left end, on which gravity acts along -z from t = 0 on. Beam
/// theory (Timoshenko): a clamp in three dimensions is a little stiffer.
struct ClampedBeam {
  BeamMaterial material;
  double gravity;     ///< [m/s^2]
  double deflection;  ///< static, of the tip [m]
  double bending1;    ///< [Hz]
};
const ClampedBeam kSoftClamped{kSoftBeam, 0.1, 4.505e-3, 0.922};
const ClampedBeam kStiffClamped{kStiffBeam, 1, 1.501e-3, 5.054};

/// Mean downward displacement [m] of the free end after each step.
inline std::vector<double> tip_deflections(const ClampedBeam& beam_spec, int across,
                                           const std::string& scheme, double dt, int steps,
                                           double window, const bem::Damping& damping = {}) {
  const bem::Material m = beam_spec.material.material();
  const bem::BodyGeometry g = geometry_of(beam(across), kBeamDensity);
  const double lam = bem::traversal_steps(g, m, dt);
  bem::PrecomputeOptions o = options_for(g, m, scheme, lam);
  o.discretisation.damping = damping;
  o.discretisation.history_length += bem::damped_history_length(lam, damping.time / dt);
  o.window = window;
  o.measure_growth = window == 0;
  bem::MemorySource source;
  source.add("b", bem::precompute(g, o));
  bem::Scene scene = one_body_scene(o.discretisation.dt);
  scene.gravity = bem::Vec3(0, 0, -beam_spec.gravity);
  bem::Selection clamp;
  clamp.kind = bem::Selection::Kind::vertices;
  clamp.indices = clamped_end(g.input);
  scene.bodies[0].fixed.push_back(clamp);
  bem::Simulation simulation(scene, source);
  std::vector<double> tip;
  for (int n = 0; n < steps; ++n) {
    simulation.step();
    const std::vector<bem::Vec3> x = bem::BodyOutput(simulation.bodies()[0]).positions();
    double sum = 0;
    int count = 0;
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (g.input.vertices[v][0] < 0.4999 * kBeamLength) continue;
      sum += g.input.vertices[v][2] - x[v][2];
      ++count;
    }
    tip.push_back(sum / count);
  }
  return tip;
}

/// Where the beam comes to rest: BDF1 with about 20 steps per period damps the motion away.
inline double resting_deflection(const ClampedBeam& b, int across) {
  return tip_deflections(b, across, "bdf1", 0.05 / b.bending1, 300, 1).back();
}

struct Ringing {
  double peak = 0;    ///< first largest deflection [m]
  double centre = 0;  ///< that the oscillation is about [m]
  double hertz = 0;   ///< from the passages through the resting position
  double growth = 0;  ///< of the amplitude, per period
};

/// First periods after gravity sets in, with 50 steps per period of beam theory; window 0 is
/// "auto".
inline Ringing ringing(const ClampedBeam& b, int across, double rest, double window,
                       const std::string& scheme = "radau2", const bem::Damping& damping = {}) {
  constexpr int kPeriods = 5;
  const double dt = 0.02 / b.bending1;
  const std::vector<double> tip =
      tip_deflections(b, across, scheme, dt, 50 * (kPeriods + 1), window, damping);
  std::vector<double> passages, extremes;  // an extreme after every passage, first a peak
  for (std::size_t n = 1; n < tip.size(); ++n) {
    if ((tip[n - 1] < rest) != (tip[n] < rest)) {
      passages.push_back(static_cast<double>(n) + (rest - tip[n]) / (tip[n] - tip[n - 1]));
      extremes.push_back(tip[n]);
    }
    if (!extremes.empty() && std::abs(tip[n] - rest) > std::abs(extremes.back() - rest))
      extremes.back() = tip[n];
  }
  Ringing r;
  r.peak = extremes.at(0);
  r.centre = 0.25 * (extremes.at(0) + 2 * extremes.at(1) + extremes.at(2));
  r.hertz = kPeriods / ((passages.at(2 * kPeriods) - passages[0]) * dt);
  const double last = extremes.at(2 * kPeriods - 2);
  r.growth = std::pow((last - rest) / (r.peak - rest), 1.0 / (kPeriods - 1));
  return r;
}

/// Prints and returns the ringing of a beam with `across` cells over its width.
inline Ringing print_ringing(const ClampedBeam& b, int across, double rest, double window,
                             const std::string& scheme = "radau2") {
  const Ringing r = ringing(b, across, rest, window, scheme);
  std::printf(
      "clamped beam, %d cells, nu %.2f, %s, window %s: rest %.4e m (%+.3f), %.4f Hz (%+.3f), "
      "peak/rest %.3f, centre/rest %.4f, growth per period %.4f\n",
      across, b.material.nu, scheme.c_str(), window == 0 ? "auto" : std::to_string(window).c_str(),
      rest, rest / b.deflection - 1, r.hertz, r.hertz / b.bending1 - 1, r.peak / rest,
      r.centre / rest, r.growth);
  return r;
}

}  // namespace bem_test
