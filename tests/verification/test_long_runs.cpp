// Long runs: bounded motion, constant momenta, and growth at the rate that the precomputation
// reports. Printed figures are quoted in docs/accuracy/stability.md, "Long runs".
#include "dynamics/body_output.hpp"
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

#ifdef BEM_FULL_LENGTH
constexpr int kSteps = 20000;
#else
constexpr int kSteps = 2000;
#endif

struct Setup {
  const char* name;
  TriangleMesh mesh;
  double nu, lam;
  double window = 0;  ///< 0: chosen by the precomputation
  Vec3 spin = Vec3::Zero();
  bool held = false;     ///< the end of least x is fixed
  double tolerance = 0;  ///< of compression; 0: none
  double push = 1;       ///< factor on the load
};

struct LongRun {
  double growth = 0, window = 1;
  double early = 0;     ///< largest displacement in the first tenth, relative to the extent
  double later = 0;     ///< and after it
  double last = 0;      ///< in the last tenth
  double rate = 0;      ///< growth factor per step over the second half
  double momentum = 0;  ///< largest change of linear and angular momentum after the push, relative
};

/// Pushes a body by a short traction on a quarter of its length and leaves it to itself.
LongRun run(const Setup& s, int steps) {
  const Material m = material(1000, 1e6, s.nu);
  const BodyGeometry g = geometry_of(s.mesh, m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", s.lam);
  o.codec = CodecOptions();
  o.window = s.window;
  o.measure_growth = true;
  if (s.tolerance > 0) o.codec = CodecOptions(codec_named("lowrank"), s.tolerance);
  BodyModel model = precompute(g, o);
  LongRun out;
  out.growth = model.report.growth;
  out.window = model.window;
  MemorySource source;
  source.add("b", std::move(model));
  const double dt = o.discretisation.dt;
  Scene scene = one_body_scene(dt);
  BodySpec& spec = scene.bodies[0];
  spec.angular_velocity = s.spin;
  double low = 0, high = 0;
  for (const Vec3& x : g.input.vertices) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  TractionSpec push;
  push.select = box_selection(Vec3(high - 0.3 * (high - low), -9, -9), Vec3(high + 1, 9, 9));
  push.load = Vec3(s.push * Vec3(3, 10, 1));  // small: stays in the linear range
  const double duration = std::ceil(s.lam) * dt;
  push.profile = {{0, 0}, {duration / 2, 1}, {duration, 0}};
  spec.tractions.push_back(push);
  if (s.held) spec.fixed.push_back(box_selection(Vec3(low - 1e-6, -9, -9), Vec3(low + 1e-6, 9, 9)));
  Simulation simulation(scene, source);
  const Body& body = simulation.bodies()[0];
  const int pushed = static_cast<int>(std::ceil(s.lam)) + 1;
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  double third_quarter = 0, fourth_quarter = 0;
  for (int n = 1; n <= steps; ++n) {
    simulation.step();
    const double u = body.displacement().cwiseAbs().maxCoeff() / g.extent;
    if (n <= steps / 10) out.early = std::max(out.early, u);
    if (n > steps / 10) out.later = std::max(out.later, u);
    if (n > steps - steps / 10) out.last = std::max(out.last, u);
    if (n > steps / 2 && n <= steps * 3 / 4) third_quarter = std::max(third_quarter, u);
    if (n > steps * 3 / 4) fourth_quarter = std::max(fourth_quarter, u);
    const Vec3 p = body.linear_momentum(), l = body.frame().angular_momentum();
    if (n == pushed) {
      linear = p;
      angular = l;
    }
    if (n > pushed)
      out.momentum = std::max({out.momentum, (p - linear).norm() / linear.norm(),
                               (l - angular).norm() / angular.norm()});
  }
  out.rate = std::pow(fourth_quarter / third_quarter, 4.0 / steps);
  std::printf(
      "%-14s %4zu vertices, nu %.2f, lam %4.1f: growth %.5f window %.5f | largest %.2e early, %.2e "
      "later, %.2e last | factor per step %.5f, momentum %.1e\n",
      s.name, g.nodes.vertices.size(), s.nu, s.lam, out.growth, out.window, out.early, out.later,
      out.last, out.rate, out.momentum);
  return out;
}

TriangleMesh beam() {
  return box(Vec3(1, 0.2, 0.2), {8, 2, 2});
}

TriangleMesh block() {
  return box(Vec3(0.3, 0.2, 0.1), {6, 4, 2});
}

}  // namespace

TEST_CASE("a pushed beam stays bounded with the automatic window") {
  std::vector<Setup> setups = {{"beam", beam(), 0.3, 3.5},
                               {"beam", beam(), 0.45, 6.5},
                               {"beam", beam(), 0.5, 6.5},
                               {"beam", beam(), 0.3, 12.5}};
#ifdef BEM_FULL_LENGTH
  const TriangleMesh fine = box(Vec3(1, 0.2, 0.2), {16, 4, 4});
  setups.insert(setups.end(), {{"beam", beam(), 0.5, 3.5},
                               {"beam", beam(), 0.3, 6.5},
                               {"beam", beam(), 0.45, 12.5},
                               {"fine beam", fine, 0.3, 3.5},
                               {"fine beam", fine, 0.5, 6.5}});
#endif
  for (const Setup& s : setups) {
    const LongRun r = run(s, kSteps);
    INFO("nu " << s.nu << ", lam " << s.lam);
    CHECK(r.growth * r.window <= 1);
    CHECK(r.later <= 1.2 * r.early);
    CHECK(r.momentum < 1e-11);
  }
}

TEST_CASE("a spinning, tumbling body stays bounded and keeps its momenta") {
  const Vec3 spin(3, 5, 1.5);
  for (const Setup& s : {Setup{"spinning block", block(), 0.3, 3.5, 0, spin},
                         Setup{"spinning block", block(), 0.45, 6.5, 0, spin},
                         Setup{"spinning star", star(1, 0.4), 0.5, 6.5, 0, spin},
                         Setup{"spinning bowl", bowl(0.5, 0.05, 16), 0.45, 12.5, 0, spin}}) {
    const LongRun r = run(s, kSteps);
    INFO(s.name << ", nu " << s.nu << ", lam " << s.lam);
    CHECK(r.later <= 1.2 * r.early);
    CHECK(r.momentum < 1e-11);
  }
}

TEST_CASE("motions of compressed bodies stay bounded") {
  const TriangleMesh beam = box(Vec3(1, 0.2, 0.2), {16, 4, 4});
  const Vec3 still = Vec3::Zero(), spin(3, 5, 1.5);
  std::vector<Setup> setups = {{"beam", beam, 0.3, 3.5, 0, still, false, 1e-2},
                               {"spinning star", star(2, 0.4), 0.4, 6.5, 0, spin, false, 1e-2}};
#ifdef BEM_FULL_LENGTH
  setups.insert(setups.end(), {{"beam", beam, 0.45, 6.5, 0, still, false, 1e-2},
                               {"beam", beam, 0.45, 6.5, 0, still, false, 1e-4},
                               {"spinning star", star(2, 0.4), 0.5, 3.5, 0, spin, false, 1e-2}});
#endif
  for (const Setup& s : setups) {
    const LongRun r = run(s, kSteps);
    INFO(s.name << ", nu " << s.nu << ", lam " << s.lam << ", tolerance " << s.tolerance);
    CHECK(r.growth * r.window <= 1);
    CHECK(r.later <= 1.2 * r.early);
    CHECK(r.momentum < 1e-11);
  }
}

TEST_CASE("without a window bodies grow at the reported factor") {
  for (Setup s : {Setup{"beam", beam(), 0.3, 3.5, 1}, Setup{"beam", beam(), 0.45, 6.5, 1},
                  Setup{"cube", box(Vec3(1, 1, 1), {3, 3, 3}), 0.3, 12.5, 1},
                  Setup{"bowl", bowl(0.5, 0.05, 16), 0.45, 12.5, 1}}) {
    s.push = 1e-10;  // leaves room to grow
    const LongRun r = run(s, 1500);
    INFO(s.name << ", nu " << s.nu << ", lam " << s.lam);
    CHECK(r.growth > 1.002);
    CHECK(r.last > 100 * r.early / s.lam);
    CHECK(r.rate == Approx(r.growth).margin(1e-3));
  }
}

TEST_CASE("without a window stable bodies come to rest") {
  for (const Setup& s : {Setup{"sphere", icosphere(1, 0.5), 0.3, 3.5, 1},
                         Setup{"sphere", icosphere(1, 0.5), 0.45, 3.5, 1},
                         Setup{"bumpy cube", bumpy_cube(1, 4, 0.2), 0.5, 6.5, 1}}) {
    const LongRun r = run(s, 1000);
    INFO(s.name << ", nu " << s.nu << ", lam " << s.lam);
    CHECK(r.growth < 1);
    // the offset of the centre of mass, t exp(-0.05 t/traversal), decays last
    CHECK(r.rate < std::max(r.growth, std::exp(-0.05 / s.lam)) + 0.003);
    CHECK(r.last < 1e-3 * r.early);
  }
}

TEST_CASE("the automatic window also calms a beam that is held at one end") {
  for (const Setup& s : {Setup{"held beam", beam(), 0.3, 3.5, 0, Vec3::Zero(), true},
                         Setup{"held beam", beam(), 0.5, 6.5, 0, Vec3::Zero(), true}}) {
    const LongRun r = run(s, kSteps);
    INFO("nu " << s.nu << ", lam " << s.lam);
    CHECK(r.later <= 1.2 * r.early);
    CHECK(r.last < 0.05 * r.early);
  }
}

TEST_CASE("a turning handle takes a windowed body along without drag") {
  // two turns at a distance; the end displacement is that of the centripetal acceleration alone
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(icosphere(1, 0.5), m.density);
  std::vector<std::vector<Vec3>> ends;
  for (const double window : {1.0, 0.95}) {
    PrecomputeOptions o = options_for(g, m, "radau2", 6.5);
    o.window = window;
    MemorySource source;
    source.add("b", precompute(g, o));
    constexpr int kTurnSteps = 1600;
    Scene scene = one_body_scene(o.discretisation.dt);
    Keyframe start, end;
    start.rotate.axis = end.rotate.axis = Vec3::UnitZ();
    start.about = end.about = Vec3(0.3, 1, 0);
    end.time = kTurnSteps * scene.time_step;
    end.rotate.angle = 4 * kPi;
    HandleSpec handle;
    handle.select = box_selection(Vec3(-0.6, -0.6, -0.6), Vec3(-0.1, 0.6, 0.6));
    handle.motion = {start, end};
    scene.bodies[0].handles.push_back(handle);
    Simulation simulation(scene, source);
    for (int n = 0; n < kTurnSteps; ++n) simulation.step();
    ends.push_back(BodyOutput(simulation.bodies()[0]).positions());
  }
  double moved = 0, difference = 0;
  for (std::size_t v = 0; v < ends[0].size(); ++v) {
    moved = std::max(moved, (ends[1][v] - g.input.vertices[v]).norm());
    difference = std::max(difference, (ends[1][v] - ends[0][v]).norm());
  }
  std::printf("turned by a handle: displaced by %.1e m, by the window %.1e m\n", moved, difference);
  CHECK(moved > 1e-4);
  CHECK(moved < 2e-3);
  CHECK(difference < 0.3 * moved);
}
