// Momentum: it equals the impulse, whatever the bodies do elastically and to each other. Printed
// figures are quoted in docs/accuracy/momentum.md, "Momentum".
#include "dynamics/rotation.hpp"
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

const char* const kSchemes[] = {"radau2", "bdf1", "bdf2", "theta:0.75"};
const Vec3 kBox(0.3, 0.2, 0.1);
constexpr int kLoadedSteps = 30, kFreeSteps = 120;

struct Momenta {
  Vec3 linear, angular;
  double time_step;
  double drift;  ///< largest change after the load has ended, relative
};

/// A box under loads with a profile that rises, stays and falls between steps 0, 10, 20 and 30,
/// each lasting in effect 20 steps; then free.
Momenta run(const char* scheme, std::vector<TractionSpec> loads) {
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(box(kBox, {3, 2, 1}), m.density);
  const PrecomputeOptions o = options_for(g, m, scheme, 1.5);
  const double dt = o.discretisation.dt;
  MemorySource source;
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(dt);
  for (TractionSpec& load : loads)
    load.profile = {{0, 0}, {10 * dt, 1}, {20 * dt, 1}, {kLoadedSteps * dt, 0}};
  scene.bodies[0].tractions = loads;
  Simulation simulation(scene, source);
  const Body& body = simulation.bodies()[0];
  const auto run_for = [&](int steps, const auto& visit) {
    for (int n = 0; n < steps; ++n) {
      simulation.step();
      visit();
    }
  };
  // multistep methods take some steps more until the last load has had its whole effect
  run_for(kLoadedSteps + 40, [] {});
  Momenta out{body.linear_momentum(), body.frame().angular_momentum(), dt, 0};
  run_for(kFreeSteps, [&] {
    const double linear = (body.linear_momentum() - out.linear).norm();
    const double angular = (body.frame().angular_momentum() - out.angular).norm();
    out.drift = std::max(
        {out.drift, linear / (out.linear.norm() + 1e-3), angular / (out.angular.norm() + 1e-3)});
  });
  return out;
}

TractionSpec end_load(double side, const Vec3& traction, bool follow) {
  TractionSpec t;
  t.select = side > 0 ? box_selection(Vec3(0.149, -1, -1), Vec3(0.151, 1, 1))
                      : box_selection(Vec3(-0.151, -1, -1), Vec3(-0.149, 1, 1));
  t.load = traction;
  t.follow = follow;
  return t;
}

/// Angular momentum [N m s] of a rigid box under a force at the middle of its right end that keeps
/// its direction: Euler's equations by the classical Runge-Kutta method.
Vec3 rigid_angular_momentum(const Vec3& force, double dt) {
  const Mat3 inverse = mass_properties(box(kBox, {1, 1, 1}), 1000).inertia.inverse();
  const Vec3 arm(kBox[0] / 2, 0, 0);
  const auto factor = [dt](double t) {
    const double n = t / dt;
    return std::max(0.0, std::min({n / 10, 1.0, (30 - n) / 10}));
  };
  struct State {
    Mat3 r = Mat3::Identity();
    Vec3 l = Vec3::Zero();
  };
  const auto rate = [&](const State& s, double t) {
    State d;
    d.r = cross_matrix(s.r * (inverse * (s.r.transpose() * s.l))) * s.r;
    d.l = factor(t) * (s.r * arm).cross(force);
    return d;
  };
  const auto moved = [](const State& s, const State& d, double h) {
    return State{s.r + h * d.r, s.l + h * d.l};
  };
  State s;
  const int steps = 100 * kLoadedSteps;
  const double h = kLoadedSteps * dt / steps;
  for (int n = 0; n < steps; ++n) {
    const double t = n * h;
    const State a = rate(s, t), b = rate(moved(s, a, h / 2), t + h / 2),
                c = rate(moved(s, b, h / 2), t + h / 2), d = rate(moved(s, c, h), t + h);
    s = moved(moved(moved(moved(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
  }
  return s.l;
}

/// A soft cube with a load that turns with it and a rigid one fall on the floor and on each other,
/// beside a bar on a joint to the world, a bar on a joint to it, and a third that a handle moves.
struct Crowd {
  MemorySource source;
  Scene scene;

  explicit Crowd(const char* scheme, double window) {
    const double dt = 2e-3;
    const Material m = material(1000, 1e6, 0.3);
    BodyModel bar = elastic_model(box(Vec3(0.3, 0.1, 0.1), {3, 1, 1}), m, dt, scheme);
    bar.window = window;
    source.add("bar", std::move(bar));
    source.add("cube", elastic_model(box(Vec3(0.2, 0.2, 0.2), {2, 2, 2}), m, dt, scheme));
    source.add("rigid", rigid_model(box(Vec3(0.2, 0.2, 0.2), {1, 1, 1}), 1500));
    scene = contact_scene(dt, Vec3(0.3, -0.2, -9.81));
    scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.4)};
    scene.bodies = {body("soft", "cube", Vec3(0, 0, 0.101)),
                    body("stiff", "rigid", Vec3(0.03, 0.02, 0.31)),
                    body("hung", "bar", Vec3(1.15, 0, 1)), body("end", "bar", Vec3(1.45, 0, 1)),
                    body("moved", "bar", Vec3(0, 2, 1))};
    scene.bodies[0].tractions = {end_load(1, Vec3(200, 100, 0), true)};
    scene.bodies[0].tractions[0].select = box_selection(Vec3(0.099, -1, -1), Vec3(0.101, 1, 1));
    scene.bodies[0].friction = 0.5;
    scene.bodies[1].velocity = Vec3(0.5, 0.2, -1);
    scene.bodies[1].angular_velocity = Vec3(1, 2, 3);
    scene.joints.resize(2);
    scene.joints[0].a = {2, Vec3(1, 0, 1), {}};
    scene.joints[1].a = {3, Vec3(1.3, 0, 1), {}};
    scene.joints[1].b = JointEnd{2, Vec3(1.3, 0, 1), {}};
    HandleSpec handle;
    handle.select = box_selection(Vec3(-0.151, -1, -1), Vec3(-0.149, 1, 1));
    handle.motion.resize(2);
    handle.motion[1].time = 0.2;
    handle.motion[1].translate = Vec3(0.1, 0.2, -0.1);
    handle.motion[1].rotate.angle = 0.5;
    scene.bodies[4].handles = {handle};
  }
};

}  // namespace

TEST_CASE("linear momentum is the impulse of loads that keep their direction") {
  const Vec3 traction(300, -200, 500);  // at one end: it also turns the body
  for (const char* scheme : kSchemes) {
    const Momenta m = run(scheme, {end_load(1, traction, false)});
    const Vec3 impulse = 20 * m.time_step * 0.2 * 0.1 * traction;
    const double error = (m.linear - impulse).norm() / impulse.norm();
    std::printf("momentum %s: linear %.1e, drift when free %.1e\n", scheme, error, m.drift);
    INFO(scheme);
    CHECK(error < 1e-13);
    CHECK(m.drift < 1e-13);
  }
}

TEST_CASE("angular momentum is the impulse of a couple that turns with the body") {
  // opposite tractions at the two ends, about a principal axis
  for (const char* scheme : kSchemes) {
    const Momenta m =
        run(scheme, {end_load(1, Vec3(0, 400, 0), true), end_load(-1, Vec3(0, -400, 0), true)});
    const double impulse = 20 * m.time_step * 0.2 * 0.1 * 400 * kBox[0];
    INFO(scheme);
    CHECK((m.angular - Vec3(0, 0, impulse)).norm() < 1e-13 * impulse);
    CHECK(m.linear.norm() < 1e-13 * impulse / kBox[0]);
    CHECK(m.drift < 1e-13);
  }
}

TEST_CASE("pressure on all of the surface moves nothing, on a part it pushes") {
  TractionSpec everywhere, end;
  everywhere.load = end.load = 1000.0;
  end.select = end_load(1, Vec3::Zero(), false).select;
  for (const char* scheme : kSchemes) {
    INFO(scheme);
    const Momenta still = run(scheme, {everywhere});
    const double scale = 20 * still.time_step * 0.02 * 1000;
    CHECK(still.linear.norm() < 1e-13 * scale);
    CHECK(still.angular.norm() < 1e-13 * scale);
    const Momenta pushed = run(scheme, {end});
    CHECK((pushed.linear - Vec3(-scale, 0, 0)).norm() < 1e-13 * scale);
    CHECK(pushed.angular.norm() < 1e-13 * scale);
  }
}

TEST_CASE("torque of a load that keeps its direction follows the turning body") {
  // exact is what the frame's rotation makes of it: the error is that of the time discretisation
  const Vec3 force(20, 40, 30);  // the box turns by about a radian meanwhile
  const std::pair<const char*, double> limits[] = {
      {"radau2", 2e-4}, {"radau3", 2e-5}, {"bdf1", 0.1}, {"bdf2", 0.01}, {"theta:0.75", 0.02}};
  for (const auto& [scheme, limit] : limits) {
    const Momenta m = run(scheme, {end_load(1, force / 0.02, false)});
    const Vec3 exact = rigid_angular_momentum(force, m.time_step);
    const double error = (m.angular - exact).norm() / exact.norm();
    std::printf("angular momentum %s, load of fixed direction: error %.1e\n", scheme, error);
    INFO(scheme);
    CHECK(error < limit);
    CHECK(m.drift < 1e-13);
  }
}

TEST_CASE("momentum of bodies in contact and on joints is the impulse from outside") {
  for (const char* scheme : kSchemes)
    for (double window : {1.0, 0.99}) {
      Crowd crowd(scheme, window);
      Simulation simulation(crowd.scene, crowd.source);
      double worst = 0, touching = 0;
      for (int n = 0; n < 100; ++n) {
        simulation.step();
        worst = std::max(worst, simulation.momentum().relative_defect());
        touching = std::max(touching, simulation.contact_forces().empty() ? 0.0 : 1.0);
      }
      const MomentumBalance& m = simulation.momentum();
      std::printf("momentum of a crowd, %s, window %.2f: relative defect %.1e\n", scheme, window,
                  worst);
      INFO(scheme << " " << window);
      CHECK(worst < 1e-12);
      CHECK(touching > 0);
      // all of them act
      for (const Vec3& impulse :
           {m.impulses.gravity, m.impulses.loads, m.impulses.joints, m.impulses.obstacles})
        CHECK(impulse.norm() > 1e-3 * m.scale);
      CHECK((m.impulses.window.norm() > 0) == (window < 1));
      // for two stages, and without the last force's rest, it is that of the bodies' velocities
      if (Scheme::parse(scheme).theta() == 0)
        CHECK((m.end - linear_momentum(simulation)).norm() < 1e-12 * m.scale);
    }
}
