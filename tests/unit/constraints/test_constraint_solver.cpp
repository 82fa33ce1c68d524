#include "support/contact_scenes.hpp"

#include <set>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

double normal_sum(const Eigen::VectorXd& forces) {
  double sum = 0;
  for (Eigen::Index i = 0; i < forces.size(); i += 3) sum += forces[i];
  return sum;
}

}  // namespace

TEST_CASE("the starting forces follow vertices from triangle to triangle") {
  MemorySource source;
  source.add("block", rigid_model(box(Vec3(0.2, 0.2, 0.1), {1, 1, 1}), 1000));
  source.add_obstacle("sheet", sheet(1, 25));  // a new triangle after every second step
  Scene scene = contact_scene(5e-3, Vec3(0, 0, -9.81));
  scene.bodies = {body("block", "block", Vec3(-0.3, 0.011, 0.0500149))};  // on the upper side
  scene.bodies[0].friction = 0.1;
  scene.bodies[0].velocity = Vec3(2, 0.3, 0);
  scene.obstacles = {mesh_obstacle("sheet", 0.1)};
  Simulation simulation(scene, source);
  std::vector<double> starts, results;
  simulation.observe_contacts(
      [&](const FrictionProblem& p, const Eigen::VectorXd& start, const FrictionResult& result) {
        CHECK(result.converged);
        CHECK(start.size() == p.q.size());
        starts.push_back(normal_sum(start));
      });
  std::set<std::pair<int, int>> pairs;
  const double weight = 0.2 * 0.2 * 0.1 * 1000 * 9.81;
  int carried = 0;
  for (int n = 0; n < 50; ++n) {
    starts.clear();
    simulation.step();
    REQUIRE(!starts.empty());
    // the first problem of the step starts from what carried the block in the last one
    if (n > 3) carried += starts[0] > 0.4 * weight;
    for (const ContactPair& c : simulation.contacts())
      if (c.body_a == 0) pairs.insert({c.contact.key.feature_a, c.contact.key.feature_b});
  }
  // A block on its whole face may be carried in many ways, and one that leaned on vertices which
  // are gone is no start.
  CHECK(carried >= 40);
  CHECK(pairs.size() > 40);  // they did change
}

TEST_CASE("steps that cannot meet their tolerance say so") {
  MemorySource source;
  source.add("block", rigid_model(box(Vec3(0.2, 0.2, 0.1), {1, 1, 1}), 1000));
  for (double tolerance : {1e-6, 1e-17}) {
    Scene scene = contact_scene(5e-3, Vec3(0, 0, -9.81));
    scene.contact.tolerance = tolerance;
    scene.bodies = {body("block", "block", Vec3(0, 0, 0.1))};
    scene.bodies[0].rotation.axis = Vec3(1, 2, 0).normalized();
    scene.bodies[0].rotation.angle = 0.1;
    scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.3)};
    Simulation simulation(scene, source);
    int missed = 0;
    for (int n = 0; n < 60; ++n) {
      simulation.step();
      const ConstraintStatistics& s = simulation.statistics();
      CHECK(s.contacts_met == (s.contact_residual <= tolerance));
      CHECK(s.joints_met);
      missed += !s.converged();
    }
    CHECK((missed > 0) == (tolerance < 1e-10));
  }
}
