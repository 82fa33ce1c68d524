// Material damping: how fast vibrations decay, against theory. A mode of the elastic body with the
// frequency w has, with moduli times 1 + s T, the decay rate w^2 T/2. Printed figures are quoted in
// docs/accuracy/vibrations.md, "Material damping".
#include "model/growth.hpp"
#include "verification/clamped_beam.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

PrecomputeOptions damped(PrecomputeOptions o, const Damping& damping, double lam) {
  o.discretisation.damping = damping;
  o.discretisation.history_length += damped_history_length(lam, damping.time / o.discretisation.dt);
  return o;
}

/// Decay rate [1/s] of the slowest motion of a free body, from its growth factor.
double decay_rate(const BodyGeometry& g, const Material& m, const Damping& damping) {
  constexpr double kLam = 10;
  const PrecomputeOptions o = damped(options_for(g, m, "radau2", kLam), damping, kLam);
  return -std::log(growth_factor(precompute(g, o)).factor) / o.discretisation.dt;
}

}  // namespace

TEST_CASE("the slowest vibration of a sphere decays as its frequency says") {
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(icosphere(2, 0.5), m.density);
  // toroidal mode n = 2 of a sphere of equal volume: w a/c2 = 2.5011; the mesh is 1 % stiffer
  const double radius = std::cbrt(3 * g.mass.volume / (4 * kPi));
  const double w = 2.5011 * 1.0096 * m.shear_speed() / radius;
  // without damping another mode is the slowest; with some it is this one, which loses a little
  // by itself
  const double few = 0.02, more = 0.06;  // of critical damping
  const double slow = decay_rate(g, m, {2 * few / w}), fast = decay_rate(g, m, {2 * more / w});
  const double measured = (fast - slow) / ((more - few) * w);
  std::printf("sphere, 0.02 to 0.06 of critical: decay rate %.4f of theory\n", measured);
  CHECK(std::abs(measured - 1) < 0.02);
}

TEST_CASE("a damped beam rings down as beam theory says, and sags as far") {
  const ClampedBeam& b = kStiffClamped;
  const double rest = resting_deflection(b, 2);
  const Ringing free = ringing(b, 2, rest, 1);
  const double loss = 0.03, w = 2 * kPi * free.hertz;
  const Ringing ring = ringing(b, 2, rest, 1, "radau2", {2 * loss / w});
  const double decrement = std::log(free.growth / ring.growth) / (2 * kPi * loss);
  std::printf("clamped beam, 0.03 of critical: decrement %.4f of theory, centre/rest %.4f\n",
              decrement, ring.centre / rest);
  CHECK(std::abs(decrement - 1) < 0.05);
  CHECK(std::abs(ring.centre / rest - 1) < 0.02);
}
