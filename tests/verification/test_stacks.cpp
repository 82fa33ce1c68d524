// Bodies that rest on each other.
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

struct StackRun {
  double moved = 0;        ///< largest horizontal way of the topmost cube, of the height
  double sunk = 0;         ///< and its way down at the end [m]
  double speed = 0;        ///< largest speed of a cube at the end [m/s]
  double penetration = 0;  ///< largest [m]
  int unconverged = 0;
  double seconds = 0;  ///< in the constraints, per step
};

/// Cubes of 0.2 m on top of each other; densities from bottom to top.
StackRun stack(bool rigid, const std::vector<double>& densities, double duration) {
  const double dt = 2e-3;
  MemorySource source;
  Scene scene = contact_scene(dt, Vec3(0, 0, -9.81));
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const std::string archive = "cube " + std::to_string(densities[i]);
    const TriangleMesh mesh = box(Vec3(0.2, 0.2, 0.2), {2, 2, 2});
    source.add(archive,
               rigid ? rigid_model(mesh, densities[i])
                     : elastic_model(mesh, material(densities[i], 1e3 * densities[i], 0.3), dt));
    scene.bodies.push_back(
        body("c" + std::to_string(i), archive, Vec3(0, 0, 0.1 + 0.2 * static_cast<double>(i))));
    scene.bodies.back().friction = 0.5;
  }
  scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.5)};
  Simulation simulation(scene, source);
  StackRun run;
  const Vec3 start = simulation.bodies().back().frame().translation();
  while (simulation.time() < duration) {
    simulation.step();
    const Vec3 way = simulation.bodies().back().frame().translation() - start;
    run.moved = std::max(run.moved, std::hypot(way[0], way[1]));
    run.sunk = -way[2];
    run.penetration = std::max(run.penetration, simulation.statistics().penetration);
    run.unconverged += !simulation.statistics().converged();
  }
  run.moved /= 0.2 * static_cast<double>(densities.size());
  for (const Body& b : simulation.bodies())
    run.speed = std::max(run.speed, b.frame().velocity().norm());
  run.seconds = simulation.times().constraints / static_cast<double>(simulation.steps());
  std::printf(
      "stack of %zu %s: moved %.2g sunk %.3g speed %.2g penetration %.2g unconverged %d, "
      "%.2f ms\n",
      densities.size(), rigid ? "rigid" : "elastic", run.moved, run.sunk, run.speed,
      run.penetration, run.unconverged, 1e3 * run.seconds);
  return run;
}

void check_stack(const StackRun& run) {
  CHECK(run.moved < 1e-4);
  CHECK(run.penetration < 1e-3 * 0.2);
  CHECK(run.speed < 0.1);
  CHECK(run.unconverged == 0);
}

}  // namespace

TEST_CASE("five cubes stand") {
  check_stack(stack(true, std::vector<double>(5, 1000.0), 1));
  check_stack(stack(false, std::vector<double>(5, 1000.0), 1));
}

TEST_CASE("a cube stands on one that is a thousand times lighter") {
  check_stack(stack(true, {1, 1000}, 1));
}

TEST_CASE("five and ten cubes stand for ten seconds", "[.][long]") {
  for (bool rigid : {true, false})
    for (std::size_t count : {std::size_t(5), std::size_t(10)})
      check_stack(stack(rigid, std::vector<double>(count, 1000.0), 10));
}
