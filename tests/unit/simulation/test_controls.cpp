// What a program changes between two steps of a simulation, against scenes that say the same
// beforehand.
#include "base/error.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/shapes.hpp"
#include "support/contact_scenes.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kStep = 0.01;

/// A rubber block that is held at one end.
class Block {
 public:
  Block() {
    Material rubber = material(1000, 1e5, 0.3);
    source_.add("b", elastic_model(box(Vec3(0.4, 0.2, 0.2), {2, 1, 1}), rubber, kStep));
    scene = one_body_scene(kStep);
    BodySpec& body = scene.bodies[0];
    body.fixed = {box_selection(Vec3(-1, -1, -1), Vec3(-0.19, 1, 1))};
  }
  Simulation simulation() { return Simulation(scene, source_); }
  BodySpec& body() { return scene.bodies[0]; }

  Scene scene;

 private:
  MemorySource source_;
};

Selection end_of_block() {
  return box_selection(Vec3(0.19, -1, -1), Vec3(1, 1, 1));
}

TractionSpec pull(const std::variant<Vec3, double>& load, Profile profile = {}) {
  TractionSpec spec;
  spec.select = end_of_block();
  spec.load = load;
  spec.profile = std::move(profile);
  return spec;
}

std::vector<Vec3> places(const Simulation& simulation) {
  return BodyOutput(simulation.bodies()[0]).positions();
}

double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

/// The motion of step n of something that goes and turns, since the start.
Keyframe pose(int n) {
  return {n * kStep, Vec3(0.002 * n, 0, 0.001 * n), {Vec3::UnitX(), 0.03 * n}, Vec3(0.2, 0, 0)};
}

}  // namespace

TEST_CASE("a traction that is set acts as one of the scene") {
  Block said, set;
  said.body().tractions = {pull(Vec3(100, 200, 0))};
  set.body().tractions = {pull(Vec3(0, 0, 0), {{0, 0.5}, {1, 2}})};
  Simulation a = said.simulation(), b = set.simulation();
  b.set_traction(0, 0, Vec3(100, 200, 0));
  for (int n = 0; n < 5; ++n) {
    a.step();
    b.step();
  }
  REQUIRE(distance(places(a), places(b)) == 0);
  REQUIRE(distance(places(a), places(said.simulation())) > 1e-4);
}

TEST_CASE("a factor that is set acts from the next step on") {
  Block said, set;
  said.body().tractions = {pull(300.0, {{0, 1}, {2 * kStep, 1}, {2 * kStep + 1e-9, 0.5}})};
  set.body().tractions = {pull(300.0)};
  Simulation a = said.simulation(), b = set.simulation();
  for (int n = 0; n < 5; ++n) {
    if (n == 2) b.set_load_factor(0, 0, 0.5);
    a.step();
    b.step();
    REQUIRE(distance(places(a), places(b)) == 0);
  }
}

TEST_CASE("a load that turns with its body keeps its direction") {
  Block block;
  block.body().tractions = {pull(300.0)};
  Simulation simulation = block.simulation();
  REQUIRE_THROWS_WITH(simulation.set_traction(0, 0, Vec3(1, 0, 0)),
                      Catch::Contains("only its factor"));
  REQUIRE_THROWS_AS(simulation.set_load_factor(0, 1, 2), std::out_of_range);
}

TEST_CASE("a handle that is moved step by step goes as one with keyframes") {
  Block said, moved;
  HandleSpec handle;
  handle.select = end_of_block();
  moved.body().handles = {handle};
  for (int n = 0; n <= 6; ++n) handle.motion.push_back(pose(n));
  said.body().handles = {handle};
  Simulation a = said.simulation(), b = moved.simulation();
  for (int n = 0; n < 6; ++n) {
    b.move_handle(0, 0, pose(n + 1));
    a.step();
    b.step();
    REQUIRE(distance(places(a), places(b)) < 1e-13);
  }
  REQUIRE(distance(places(b), places(moved.simulation())) > 0.01);
  const std::vector<Vec3> held = places(b);
  b.step();  // it stays where it was brought
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i].x() > 0.19) REQUIRE((places(b)[i] - held[i]).norm() < 1e-9);
  b.release_handle(0, 0);
  b.step();
  REQUIRE(distance(places(b), held) > 1e-4);
}

TEST_CASE("an obstacle that is moved step by step pushes as one with keyframes") {
  MemorySource source;
  source.add("box", rigid_model(box(Vec3(0.1, 0.1, 0.1), {1, 1, 1}), 1000));
  source.add_obstacle("plate", sheet(1, 2));
  Scene scene = contact_scene(kStep, Vec3(0, 0, -9.81));
  scene.bodies = {body("box", "box", Vec3(0, 0, 0.0501))};
  scene.obstacles = {mesh_obstacle("plate", 0.5), plane(Vec3(0, 0, -1), Vec3::UnitZ(), 0)};
  Scene said = scene;
  for (int n = 0; n <= 8; ++n)
    std::get<MeshObstacle>(said.obstacles[0].shape)
        .motion.push_back(
            {n * kStep, Vec3(0, 0, 0.004 * n), {Vec3::UnitZ(), 0.05 * n}, Vec3::Zero()});
  Simulation a(said, source), b(scene, source);
  for (int n = 0; n < 8; ++n) {
    b.move_obstacle(
        0, {0, Vec3(0, 0, 0.004 * (n + 1)), {Vec3::UnitZ(), 0.05 * (n + 1)}, Vec3::Zero()});
    a.step();
    b.step();
    REQUIRE(distance(places(a), places(b)) < 1e-12);
  }
  REQUIRE(places(b)[0].z() > 0.01);
  REQUIRE_THROWS_WITH(b.move_obstacle(1, {}), Catch::Contains("is a plane"));
}
