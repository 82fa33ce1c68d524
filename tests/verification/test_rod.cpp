// Rod of 1 x 0.2 x 0.2 m with nu = 0 under a suddenly applied end load: exact in three dimensions.
#include "dynamics/body_output.hpp"
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
  double delayed = 0;   ///< the same against the solution theta/2 steps earlier
  double peak = 0;      ///< largest end displacement / static
  double lateral = 0;   ///< largest sideways displacement / static
  double momentum = 0;  ///< largest error of the linear momentum, relative to the impulse
  /// Mean stress of the fixed face / applied load, middle of the plateaus 0-1, 1-3, 3-5 and 5-7
  /// traversals; exact: 0, 2, 0, 2.
  std::array<double, 4> reaction = {};
};

/// Averages the stress of the fixed face over the middle 60 % of every plateau.
class ReactionMeter {
 public:
  explicit ReactionMeter(const TriangleMesh& mesh) : mesh_(mesh), areas_(vertex_areas(mesh)) {}

  void sample(const Body& body, double t) {
    const std::vector<Vec3> tractions = BodyOutput(body).tractions();
    double force = 0;
    for (std::size_t v = 0; v < areas_.size(); ++v)
      if (mesh_.vertices[v][0] < -0.4999) force += areas_[v] * tractions[v][0];
    const double ends[] = {0, 1, 3, 5, 7};
    for (int i = 0; i < 4; ++i) {
      const double position = (t * kSpeed / kLength - ends[i]) / (ends[i + 1] - ends[i]);
      if (position < 0.2 || position > 0.8) continue;
      sums_[i] -= force / (0.04 * kLoad);
      ++counts_[i];
    }
  }
  std::array<double, 4> means() const {
    std::array<double, 4> m;
    for (int i = 0; i < 4; ++i) m[i] = sums_[i] / counts_[i];
    return m;
  }

 private:
  const TriangleMesh& mesh_;
  std::vector<double> areas_;
  double sums_[4] = {};
  int counts_[4] = {};
};

RodRun run_rod(const char* scheme, bool fixed, int cells, double steps_per_period,
               const char* frame = "moving", bool double_nodes = false) {
  const Material m = material(kDensity, kYoung / 2, 0);
  BodyGeometry g = geometry_of(box(Vec3(kLength, 0.2, 0.2), {5 * cells, cells, cells}), m.density);
  if (double_nodes) g.corner_angle_deg = 40;
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
  ReactionMeter reaction(g.input);
  const int steps = static_cast<int>(std::lround(2 * steps_per_period));
  for (int n = 1; n <= steps; ++n) {
    simulation.step();
    const std::vector<Vec3> x = BodyOutput(simulation.bodies()[0]).positions();
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
    const double late = t - 0.5 * o.discretisation.scheme.theta() * o.discretisation.dt;
    run.rms += std::pow((mean - exact(fixed, kLength, t)) / kStatic, 2) / steps;
    run.delayed += std::pow((mean - exact(fixed, kLength, late)) / kStatic, 2) / steps;
    run.peak = std::max(run.peak, mean / kStatic);
    if (fixed) {
      reaction.sample(simulation.bodies()[0], t);
    } else {
      const double impulse = kLoad * 0.04 * t;
      const Vec3 error = simulation.bodies()[0].linear_momentum() - Vec3(impulse, 0, 0);
      run.momentum = std::max(run.momentum, error.norm() / impulse);
    }
  }
  run.rms = std::sqrt(run.rms);
  run.delayed = std::sqrt(run.delayed);
  run.reaction = reaction.means();
  std::printf(
      "rod %s%s %s, %d cells, %.0f steps/period, lam %.2f, n_max %d: rms %.4f (delayed %.4f) "
      "peak %.3f lateral %.2g",
      fixed ? "fixed" : "free", double_nodes ? " with double nodes" : "", scheme, cells,
      steps_per_period, g.extent / (m.shear_speed() * dt), o.discretisation.history_length, run.rms,
      run.delayed, run.peak, run.lateral);
  if (fixed)
    std::printf(" reaction %.3f %.3f %.3f %.3f\n", run.reaction[0], run.reaction[1],
                run.reaction[2], run.reaction[3]);
  else
    std::printf(" momentum %.2g\n", run.momentum);
  return run;
}

/// Errors that were measured: rms, and of the reaction at its plateaus.
struct Limit {
  const char* scheme;
  double rms, reaction;
};

void check_fixed(const Limit& limit, int cells, double steps) {
  const RodRun run = run_rod(limit.scheme, true, cells, steps);
  INFO(limit.scheme);
  CHECK(run.rms < 1.1 * limit.rms);
  for (int i = 0; i < 4; ++i)
    CHECK(std::abs(run.reaction[i] - (i % 2 ? 2 : 0)) < 1.1 * limit.reaction);
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
  for (const Limit& l : {Limit{"bdf1", 0.258, 0.50}, Limit{"theta:0.75", 0.121, 0.13},
                         Limit{"bdf2", 0.092, 0.05}, Limit{"radau2", 0.038, 0.03}})
    check_fixed(l, 2, 40);
}

TEST_CASE("fixed rod: double nodes at the edges of the held face") {
  const RodRun run = run_rod("radau2", true, 2, 40, "moving", true);
  CHECK(run.rms < 0.038);
  for (int i = 0; i < 4; ++i) CHECK(std::abs(run.reaction[i] - (i % 2 ? 2 : 0)) < 0.03);
}

TEST_CASE("fixed rod: a finer mesh and smaller steps reduce the error") {
  const RodRun coarse = run_rod("radau2", true, 1, 20);
  const RodRun fine = run_rod("radau2", true, 2, 40);
  CHECK(fine.rms < 0.4 * coarse.rms);
  CHECK(fine.peak > coarse.peak);
}

TEST_CASE("rods: every scheme, and a finer mesh", "[.][long]") {
  for (const Limit& l : {Limit{"bdf1", 0.156, 0.26}, Limit{"theta:0.75", 0.066, 0.04},
                         Limit{"bdf2", 0.047, 0.05}, Limit{"radau2", 0.0134, 0.01}})
    check_fixed(l, 4, 80);
  const std::tuple<const char*, double, double> free[] = {{"bdf1", 0.262, 0.140},
                                                          {"theta:0.75", 0.144, 0.089},
                                                          {"bdf2", 0.238, 0.134},
                                                          {"radau2", 0.031, 0.022}};
  for (const auto& [scheme, coarse, fine] : free) {
    CHECK(run_rod(scheme, false, 2, 40).rms < 1.1 * coarse);
    CHECK(run_rod(scheme, false, 4, 80).rms < 1.1 * fine);
  }
}

TEST_CASE("fixed rod: order of the time discretisation", "[.][long]") {
  // the velocity jumps: bdf1 smears it over sqrt(t dt)
  double last = run_rod("bdf1", true, 2, 40).rms;
  for (double steps : {80.0, 160.0}) {
    const double rms = run_rod("bdf1", true, 2, steps).rms;
    const double order = std::log2(last / rms);
    std::printf("order %.2f\n", order);
    CHECK(order > 0.5);
    CHECK(order < 1);
    last = rms;
  }
}

TEST_CASE("a stationary frame gives the same small motion as a moving one") {
  const RodRun moving = run_rod("radau2", true, 2, 40);
  const RodRun stationary = run_rod("radau2", true, 2, 40, "static");
  CHECK(stationary.rms == Approx(moving.rms).epsilon(1e-3));
}
