// Rod of 1 x 0.2 x 0.2 m with nu = 0 under a suddenly applied end load: exact in three dimensions.
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kLength = 1, kDensity = 1000, kYoung = 9e5, kLoad = 900;
const double kSpeed = std::sqrt(kYoung / kDensity);
const double kStatic = kLoad * kLength / kYoung;
const double kPeriod = 4 * kLength / kSpeed;

double ramp(double t) {
  return t > 0 ? t : 0;
}

/// End displacements by summation of reflected waves; x from the unloaded end.
double exact(bool fixed, double x, double t) {
  double sum = 0;
  for (int k = 0; k < 40; ++k) {
    const double arrival = t - ((2 * k + 1) * kLength - x) / kSpeed;
    const double echo = t - ((2 * k + 1) * kLength + x) / kSpeed;
    sum += fixed ? (k % 2 ? -1 : 1) * (ramp(arrival) - ramp(echo)) : ramp(arrival) + ramp(echo);
  }
  return kLoad * kSpeed / kYoung * sum;
}

struct RodRun {
  double rms = 0;       ///< of the loaded end's mean displacement, over two periods, / static
  double peak = 0;      ///< largest end displacement / static
  double lateral = 0;   ///< largest sideways displacement / static
  double momentum = 0;  ///< largest error of the linear momentum, relative to the impulse
};

RodRun run_rod(const char* scheme, bool fixed, int cells, double steps_per_period,
               const char* frame = "moving") {
  const Material m = material(kDensity, kYoung / 2, 0);
  const BodyGeometry g =
      geometry_of(box(Vec3(kLength, 0.2, 0.2), {5 * cells, cells, cells}), m.density);
  const double dt = kPeriod / steps_per_period;
  PrecomputeOptions o = options_for(g, m, scheme, g.extent / (m.shear_speed() * dt));
  MemorySource source;
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(o.discretisation.dt);
  BodySpec& body = scene.bodies[0];
  body.frame = std::string(frame) == "static" ? FrameMotion::stationary : FrameMotion::moving;
  TractionSpec load;
  load.select = box_selection(Vec3(0.4999, -1, -1), Vec3(0.5001, 1, 1));
  load.load = Vec3(kLoad, 0, 0);
  body.tractions.push_back(load);
  if (fixed) body.fixed.push_back(box_selection(Vec3(-0.5001, -1, -1), Vec3(-0.4999, 1, 1)));
  Simulation simulation(scene, source);
  RodRun run;
  const int steps = static_cast<int>(std::lround(2 * steps_per_period));
  for (int n = 1; n <= steps; ++n) {
    simulation.step();
    const std::vector<Vec3> x = simulation.bodies()[0].positions();
    double mean = 0;
    int count = 0;
    for (std::size_t v = 0; v < x.size(); ++v) {
      const Vec3 u = x[v] - g.input.vertices[v];
      run.lateral = std::max({run.lateral, std::abs(u[1]) / kStatic, std::abs(u[2]) / kStatic});
      if (g.input.vertices[v][0] < 0.4999) continue;
      mean += u[0];
      ++count;
    }
    mean /= count;
    const double t = simulation.time();
    run.rms += std::pow((mean - exact(fixed, kLength, t)) / kStatic, 2) / steps;
    run.peak = std::max(run.peak, mean / kStatic);
    if (!fixed) {
      const double impulse = kLoad * 0.04 * t;
      const Vec3 error = simulation.bodies()[0].linear_momentum() - Vec3(impulse, 0, 0);
      run.momentum = std::max(run.momentum, error.norm() / impulse);
    }
  }
  run.rms = std::sqrt(run.rms);
  std::printf(
      "rod %s %s, %d cells, %.0f steps/period, lam %.2f, n_max %d: rms %.4f peak %.3f "
      "lateral %.2g momentum %.2g\n",
      fixed ? "fixed" : "free", scheme, cells, steps_per_period, g.extent / (m.shear_speed() * dt),
      o.discretisation.history_length, run.rms, run.peak, run.lateral, run.momentum);
  return run;
}

}  // namespace

TEST_CASE("free rod under an end load: displacement, and momentum equal to the impulse") {
  const RodRun radau = run_rod("radau2", false, 2, 40);
  CHECK(radau.rms < 0.04);
  CHECK(radau.lateral < 0.02);
  CHECK(radau.momentum < 1e-13);
  CHECK(run_rod("bdf1", false, 2, 40).momentum < 1e-13);
}

TEST_CASE("fixed rod under an end load: every scheme reaches its accuracy") {
  // limits: 1.15 times the errors of docs/accuracy.md
  const std::pair<const char*, double> limits[] = {
      {"bdf1", 0.30}, {"theta:0.75", 0.14}, {"bdf2", 0.106}, {"radau2", 0.044}};
  for (const auto& [scheme, limit] : limits) CHECK(run_rod(scheme, true, 2, 40).rms < limit);
}

TEST_CASE("fixed rod: a finer mesh and smaller steps reduce the error") {
  const RodRun coarse = run_rod("radau2", true, 2, 40);
  const RodRun fine = run_rod("radau2", true, 4, 80);
  CHECK(fine.rms < 0.5 * coarse.rms);
  CHECK(fine.peak > coarse.peak);
}

TEST_CASE("a stationary frame gives the same small motion as a moving one") {
  const RodRun moving = run_rod("radau2", true, 2, 40);
  const RodRun stationary = run_rod("radau2", true, 2, 40, "static");
  CHECK(stationary.rms == Approx(moving.rms).epsilon(1e-3));
}
