// Impacts against closed forms: the flat drop of an elastic cube, elastic balls.
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kSide = 0.2, kDensity = 1000;
const double kPressureSpeed = std::sqrt(2e6 / kDensity);          // nu = 0, shear modulus 1e6 Pa
const double kForce = kDensity * kPressureSpeed * kSide * kSide;  // at 1 m/s
const double kContactTime = 2 * kSide / kPressureSpeed;

struct DropRun {
  double force = 0;     ///< mean contact force / exact
  double time = 0;      ///< end of the last step with contact / exact
  double rebound = 0;   ///< velocity after contact [m/s], exact 1
  double lowest = 0;    ///< largest way of the centre of mass / exact
  double momentum = 0;  ///< error, relative
};

/// A nu = 0 cube falls flat on a frictionless floor at 1 m/s without gravity.
DropRun drop_cube(const char* scheme, int cells, int steps_per_contact) {
  const Material m = material(kDensity, 1e6, 0);
  const double dt = kContactTime / steps_per_contact;
  MemorySource source;
  source.add("cube",
             elastic_model(box(Vec3(kSide, kSide, kSide), {cells, cells, cells}), m, dt, scheme));
  Scene scene = contact_scene(dt, Vec3::Zero());
  scene.bodies = {body("cube", "cube", Vec3(0, 0, 0.5 * kSide))};
  scene.bodies[0].velocity = Vec3(0, 0, -1);
  scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0)};
  Simulation simulation(scene, source);
  const Body& cube = simulation.bodies()[0];
  DropRun run;
  double impulse = 0;
  for (int n = 0; n < 2 * steps_per_contact; ++n) {
    simulation.step();
    const double force = total_contact_force(simulation)[2];
    impulse += force * dt;
    if (force > 0) run.time = simulation.time() / kContactTime;
    const double way = 0.5 * kSide - cube.frame().translation()[2];
    run.lowest = std::max(run.lowest, way / (0.5 * kSide / kPressureSpeed));
  }
  run.rebound = cube.frame().velocity()[2];
  run.force = impulse / (run.time * kContactTime * kForce);
  const double mass = cube.frame().mass();
  run.momentum = std::abs(mass * (run.rebound + 1) - impulse) / mass;
  std::printf(
      "drop %s, %d cells, %d steps: force %.3f time %.3f rebound %.3f way %.4f momentum %.1g\n",
      scheme, cells, steps_per_contact, run.force, run.time, run.rebound, run.lowest, run.momentum);
  return run;
}

void check_drop(const DropRun& run, double tolerance) {
  CHECK(run.force == Approx(1).margin(tolerance));
  CHECK(run.time == Approx(1).margin(tolerance));
  CHECK(run.rebound == Approx(1).margin(tolerance));
  CHECK(run.lowest == Approx(1).margin(0.5 * tolerance));
  CHECK(run.momentum < 1e-13);
}

struct BallRun {
  double time = 0, approach = 0;  ///< of the contact, relative to Hertz
  double patch = 0;               ///< contact radius / radius of the ball by Hertz
};

/// An elastic ball (half of a symmetric collision) on a frictionless plane.
BallRun drop_ball(int level, double speed, double dt_part) {
  const Material m = material(1000, 1e6, 0.3);
  const double radius = 0.05, mass = 1000 * 4 / 3.0 * kPi * std::pow(radius, 3);
  const double modulus = 2 * m.shear_modulus * 1.3 / (1 - 0.09);
  const double depth =
      std::pow(15 * mass * speed * speed / (16 * std::sqrt(radius) * modulus), 0.4);
  const double time = 2.943 * depth / speed;
  const double dt = dt_part * time;
  MemorySource source;
  source.add("ball", elastic_model(icosphere(level, radius), m, dt));
  Scene scene = contact_scene(dt, Vec3::Zero());
  scene.bodies = {body("ball", "ball", Vec3(0, 0, radius))};
  scene.bodies[0].velocity = Vec3(0, 0, -speed);
  scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0)};
  Simulation simulation(scene, source);
  BallRun run;
  run.patch = std::sqrt(depth / radius);
  double first = -1, last = 0;
  for (int n = 0; n < 2.5 / dt_part; ++n) {
    simulation.step();
    if (total_contact_force(simulation)[2] > 0) {
      if (first < 0) first = simulation.time() - dt;
      last = simulation.time();
    }
    run.approach =
        std::max(run.approach, (radius - simulation.bodies()[0].frame().translation()[2]) / depth);
  }
  run.time = (last - first) / time;
  std::printf(
      "ball level %d, %.2g m/s: contact time %.3f, approach %.3f of Hertz, a/R %.3f, rebound "
      "%.3f\n",
      level, speed, run.time, run.approach, run.patch,
      simulation.bodies()[0].frame().velocity()[2] / speed);
  return run;
}

}  // namespace

TEST_CASE("flat drop of a cube: force, contact time and rebound") {
  check_drop(drop_cube("radau2", 4, 40), 0.06);
}

TEST_CASE("flat drop of a cube: finer meshes and steps", "[.][long]") {
  check_drop(drop_cube("radau2", 8, 80), 0.04);
  drop_cube("bdf1", 4, 40);
  drop_cube("theta:0.75", 4, 40);
  drop_cube("bdf2", 4, 40);
}

TEST_CASE("an elastic ball meets a plane as Hertz says", "[.][long]") {
  const BallRun run = drop_ball(3, 2, 0.03);
  CHECK(run.time == Approx(1).epsilon(0.15));
  CHECK(run.approach == Approx(1).epsilon(0.15));
}

TEST_CASE("balls collide: momentum of both kinds is kept") {
  const Material m = material(1000, 1e6, 0.3);
  const double dt = 5e-4;
  for (double ratio : {1.0, 1.6}) {
    MemorySource source;
    source.add("small", elastic_model(icosphere(1, 0.05), m, dt));
    source.add("large", elastic_model(icosphere(1, 0.05 * ratio), m, dt));
    Scene scene = contact_scene(dt, Vec3::Zero());
    scene.bodies = {body("a", "small", Vec3(-0.052, 0.01, 0)),
                    body("b", "large", Vec3(0.05 * ratio, 0, 0))};
    for (BodySpec& b : scene.bodies) b.friction = 0.5;
    scene.bodies[0].velocity = Vec3(1, 0, 0);
    Simulation simulation(scene, source);
    const Vec3 start = linear_momentum(simulation), spin = angular_momentum(simulation);
    int touching = 0;
    for (int n = 0; n < 150; ++n) {
      simulation.step();
      touching += simulation.statistics().contacts > 0;
    }
    CHECK(touching > 5);
    CHECK(simulation.bodies()[1].frame().velocity()[0] > 0.1);
    CHECK((linear_momentum(simulation) - start).norm() < 1e-12 * start.norm());
    const double turning = (angular_momentum(simulation) - spin).norm() / (start.norm() * 0.05);
    std::printf("balls 1:%.1f: %d steps of contact, angular momentum kept to %.2g\n", ratio,
                touching, turning);
    CHECK(turning < 1e-6);
    CHECK(simulation.momentum().angular_start.isApprox(spin, 1e-12));
    CHECK(simulation.momentum().angular_end.isApprox(angular_momentum(simulation), 1e-12));
  }
}
