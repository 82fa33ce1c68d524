// Contact and friction against closed forms: flat drop of an elastic cube, sliding block.
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

ObstacleSpec plane(const Vec3& point, const Vec3& normal, double friction) {
  ObstacleSpec o;
  o.name = "floor";
  o.shape = PlaneObstacle{point, normal};
  o.friction = friction;
  return o;
}

Vec3 contact_force(const Simulation& simulation) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& f : simulation.contact_forces()) sum += f;
  return sum;
}

struct DropRun {
  double force = 0;    ///< mean contact force
  double leaves = 0;   ///< time of the last contact
  double rebound = 0;  ///< velocity of the centre of mass after contact
  double lowest = 0;   ///< of the centre of mass
  double momentum = 0;
};

/// A nu = 0 cube of side 0.2 m falls flat on a frictionless floor at 1 m/s without gravity.
DropRun drop_cube(const char* scheme, int cells, double steps_per_contact) {
  constexpr double kSide = 0.2;
  const Material m = material(1000, 1e6, 0);
  const double c = std::sqrt(2.0) * m.shear_speed();
  const BodyGeometry g = geometry_of(box(Vec3(kSide, kSide, kSide), {cells, cells, cells}), 1000);
  const double dt = 2 * kSide / c / steps_per_contact;
  const PrecomputeOptions o = options_for(g, m, scheme, g.extent / (m.shear_speed() * dt));
  MemorySource source;
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(o.discretisation.dt);
  scene.bodies[0].position = Vec3(0, 0, 0.5 * kSide);
  scene.bodies[0].velocity = Vec3(0, 0, -1);
  scene.obstacles.push_back(plane(Vec3::Zero(), Vec3::UnitZ(), 0));
  scene.contact.enabled = true;
  Simulation simulation(scene, source);
  DropRun run;
  double impulse = 0;
  for (int n = 1; n <= 3 * steps_per_contact; ++n) {
    simulation.step();
    const double f = contact_force(simulation)[2];
    impulse += f * dt;
    if (f > 0) run.leaves = simulation.time();
    const Body& b = simulation.bodies()[0];
    run.lowest = std::min(run.lowest, b.frame().translation()[2] - 0.5 * kSide);
    if (n <= 8 || n % 8 == 0)
      std::printf("%3d t %.5f f %.1f contacts %zu it %d com %.6f v %.4f pen %.2g err %.2g\n", n,
                  simulation.time(), f, simulation.contacts().size(),
                  simulation.statistics().iterations, b.frame().translation()[2],
                  b.frame().velocity()[2], simulation.statistics().penetration,
                  simulation.statistics().contact_error);
  }
  const Body& b = simulation.bodies()[0];
  run.rebound = b.frame().velocity()[2];
  run.force = impulse / run.leaves;
  run.momentum = std::abs(b.linear_momentum()[2] + b.frame().mass() - impulse);
  std::printf("drop %s %d cells %.0f steps: force %.1f (1788.85) contact %.3f ms (8.944) rebound %.4f lowest %.4g (-2.236e-3) momentum %.2g\n",
              scheme, cells, steps_per_contact, run.force, 1e3 * run.leaves, run.rebound,
              run.lowest, run.momentum);
  return run;
}

}  // namespace

TEST_CASE("flat drop of a cube") {
  drop_cube("radau2", 4, 40);
  drop_cube("bdf1", 4, 40);
}
