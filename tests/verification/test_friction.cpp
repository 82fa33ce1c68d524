// Coulomb friction of a stiff block against closed forms.
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kGravity = 9.81;

/// A flat block of 0.4 x 0.4 x 0.1 m on a plane; `slope`: its tangent, downhill is +x.
struct Block {
  Block(bool rigid, double dt, double friction, double slope, const Vec3& velocity,
        FrictionMethod solver = FrictionMethod::newton)
      : simulation(make(rigid, dt, friction, slope, velocity, solver)) {}

  Vec3 run(double duration) {
    while (simulation->time() < duration - 1e-9) simulation->step();
    return simulation->bodies()[0].frame().translation() - Vec3(0, 0, 0.05);
  }

  std::unique_ptr<Simulation> simulation;

 private:
  std::unique_ptr<Simulation> make(bool rigid, double dt, double friction, double slope,
                                   const Vec3& velocity, FrictionMethod solver) {
    MemorySource source;
    const TriangleMesh mesh = box(Vec3(0.4, 0.4, 0.1), {4, 4, 1});
    source.add("block",
               rigid ? rigid_model(mesh, 1000) : elastic_model(mesh, material(1000, 1e7, 0.3), dt));
    const double angle = std::atan(slope);
    Scene scene = contact_scene(dt, kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
    scene.bodies = {body("block", "block", Vec3(0, 0, 0.05))};
    scene.bodies[0].velocity = velocity;
    scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), friction)};
    scene.contact.solver = solver;
    return std::make_unique<Simulation>(scene, source);
  }
};

}  // namespace

TEST_CASE("a sliding block stops where Coulomb says") {
  for (bool rigid : {false, true})
    for (double friction : {0.2, 0.4, 0.6})
      for (double speed : {1.0, 2.0}) {
        Block block(rigid, 1e-3, friction, 0, Vec3(speed, 0, 0));
        const double time = speed / (friction * kGravity), way = 0.5 * speed * time;
        const double error = block.run(1.2 * time)[0] / way - 1;
        std::printf("slide %s mu %.1f v %.0f: error %.2g\n", rigid ? "rigid" : "elastic", friction,
                    speed, error);
        CHECK(std::abs(error) < 0.01);
      }
}

TEST_CASE("friction has no preferred direction") {
  const double way = 1 / (2 * 0.4 * kGravity);
  for (double degrees : {0.0, 30.0, 45.0, 90.0}) {
    const double a = degrees * kPi / 180;
    Block block(false, 1e-3, 0.4, 0, Vec3(std::cos(a), std::sin(a), 0));
    const Vec3 x = block.run(0.3);
    CHECK(std::hypot(x[0], x[1]) == Approx(way).epsilon(1e-3));
    CHECK(std::atan2(x[1], x[0]) == Approx(a).margin(1e-4));
  }
}

TEST_CASE("a block on a slope sticks below the friction angle and slides above it") {
  for (bool rigid : {false, true})
    for (double friction : {0.2, 0.6})
      for (double ratio : {0.8, 0.98, 1.02, 1.25}) {
        Block block(rigid, 1e-3, friction, ratio * friction, Vec3::Zero());
        const double x = block.run(0.5)[0];
        const double angle = std::atan(ratio * friction);
        const double sliding =
            0.5 * 0.25 * kGravity * (std::sin(angle) - friction * std::cos(angle));
        std::printf("slope %s mu %.1f ratio %.2f: moved %.3g m, sliding %.3g\n",
                    rigid ? "rigid" : "elastic", friction, ratio, x, sliding);
        if (ratio < 1)
          CHECK(std::abs(x) < 1e-4);
        else  // while the block settles it is lighter than at rest
          CHECK(x == Approx(sliding).epsilon(0.01).margin(rigid ? 1e-6 : 1.2e-3));
      }
}

TEST_CASE("all contact solvers find the same sliding") {
  const double way = 1 / (2 * 0.4 * kGravity);
  for (FrictionMethod solver :
       {FrictionMethod::newton, FrictionMethod::nsgs, FrictionMethod::staggered}) {
    Block block(false, 2e-3, 0.4, 0, Vec3(1, 0, 0), solver);
    CHECK(block.run(0.3)[0] == Approx(way).epsilon(2e-3));
    CHECK(block.simulation->statistics().converged());
  }
}
