// Bodies connected by joints.
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

JointSpec point_joint(std::size_t a, std::optional<std::size_t> b, const Vec3& point) {
  JointSpec j;
  j.a.body = a;
  j.a.point = point;
  if (b) {
    j.b.emplace();
    j.b->body = *b;
    j.b->point = point;
  }
  return j;
}

JointSpec weld(std::size_t a, std::size_t b) {
  JointSpec j;
  j.type = JointType::weld;
  j.a.body = a;
  j.b.emplace();
  j.b->body = b;
  return j;
}

HandleSpec turning_handle(double x, double turn, double duration) {
  HandleSpec h;
  h.select = box_selection(Vec3(x - 1e-3, -1, -1), Vec3(x + 1e-3, 1, 1));
  Keyframe start, end;
  end.time = duration;
  end.rotate.angle = turn;
  h.motion = {start, end};
  return h;
}

}  // namespace

TEST_CASE("a rigid pendulum on a point joint swings with its period") {
  // a bar hung at its end face, released from a small angle
  MemorySource source;
  source.add("bar", rigid_model(box(Vec3(1, 0.04, 0.04), {2, 2, 2}), 1000));
  Scene scene;
  scene.time_step = 5e-3;
  scene.gravity = Vec3(0, 0, -9.81);
  const double angle = 0.05;
  scene.bodies = {body("bar", "bar", 0.5 * Vec3(std::sin(angle), 0, -std::cos(angle)))};
  scene.bodies[0].rotation.axis = Vec3::UnitY();
  scene.bodies[0].rotation.angle = 0.5 * kPi - angle;
  scene.joints = {point_joint(0, std::nullopt, Vec3::Zero())};
  Simulation simulation(scene, source);
  const double inertia = (1 + 0.04 * 0.04) / 12 + 0.25;  // per mass, about the joint
  const double period = 2 * kPi * std::sqrt(inertia / (9.81 * 0.5)) * (1 + angle * angle / 16);
  double last = 1, crossed = 0;
  int crossings = 0;
  while (crossings < 6) {
    simulation.step();
    const double x = simulation.bodies()[0].frame().translation()[0];
    if (x * last < 0) {
      ++crossings;
      crossed = simulation.time() - scene.time_step * std::abs(x) / (std::abs(x) + std::abs(last));
    }
    last = x;
    REQUIRE(simulation.time() < 10);
  }
  CHECK(crossed == Approx((0.25 + 5 * 0.5) * period).epsilon(1e-4));
}

TEST_CASE("a chain of ten bodies hangs together and does not gain energy") {
  for (bool rigid : {true, false}) {
    const double dt = 2e-3;
    const TriangleMesh mesh = box(Vec3(0.2, 0.05, 0.05), {4, 2, 2});
    MemorySource source;
    source.add("link",
               rigid ? rigid_model(mesh, 1000) : elastic_model(mesh, material(1000, 1e6, 0.3), dt));
    Scene scene;
    scene.time_step = dt;
    scene.gravity = Vec3(0, 0, -9.81);
    for (std::size_t i = 0; i < 10; ++i) {
      const double x = 0.2 * static_cast<double>(i);
      scene.bodies.push_back(body("l" + std::to_string(i), "link", Vec3(0.1 + x, 0, 0)));
      scene.joints.push_back(
          point_joint(i, i > 0 ? std::optional<std::size_t>(i - 1) : std::nullopt, Vec3(x, 0, 0)));
    }
    Simulation simulation(scene, source);
    double highest = -1;
    for (int n = 0; n < 600; ++n) {
      simulation.step();
      CHECK(simulation.statistics().joint_residual < 1e-11);
      double energy = 0;
      for (const Body& b : simulation.bodies())
        energy += b.frame().mass() *
                  (0.5 * b.frame().velocity().squaredNorm() + 9.81 * b.frame().translation()[2]);
      highest = std::max(highest, energy);
    }
    CHECK(highest < 1e-3);
    CHECK(simulation.bodies().back().frame().translation()[2] < -0.1);
  }
}

TEST_CASE("a floating pair of welded cubes keeps its momentum") {
  const double dt = 2e-3;
  MemorySource source;
  source.add("cube",
             elastic_model(box(Vec3(0.2, 0.2, 0.2), {2, 2, 2}), material(1000, 1e6, 0.3), dt));
  Scene scene;
  scene.time_step = dt;
  scene.bodies = {body("a", "cube", Vec3(-0.1, 0, 0)), body("b", "cube", Vec3(0.1, 0, 0))};
  // a rigid spin about z
  scene.bodies[0].velocity = Vec3(0, -0.5, 0);
  scene.bodies[1].velocity = Vec3(0, 0.5, 0);
  for (BodySpec& b : scene.bodies) b.angular_velocity = Vec3(0, 0, 5);
  scene.joints = {weld(0, 1)};
  Simulation simulation(scene, source);
  const Vec3 spin = angular_momentum(simulation);
  for (int n = 0; n < 400; ++n) simulation.step();
  CHECK(linear_momentum(simulation).norm() < 1e-12);
  const Vec3 change = angular_momentum(simulation) - spin;
  std::printf("welded pair: angular momentum changed by %.2g\n", change.norm() / spin.norm());
  CHECK(change.norm() < 1e-3 * spin.norm());
}

TEST_CASE("a beam of five welded cubes is twisted by half a turn") {
  const double dt = 4e-3;
  MemorySource source;
  source.add("cube",
             elastic_model(box(Vec3(0.2, 0.2, 0.2), {2, 2, 2}), material(1000, 1e6, 0.3), dt));
  Scene scene;
  scene.time_step = dt;
  for (std::size_t i = 0; i < 5; ++i) {
    scene.bodies.push_back(
        body("c" + std::to_string(i), "cube", Vec3(0.1 + 0.2 * static_cast<double>(i), 0, 0)));
    if (i > 0) scene.joints.push_back(weld(i - 1, i));
  }
  scene.bodies[0].handles = {turning_handle(-0.1, 0, 1)};
  scene.bodies[4].handles = {turning_handle(0.1, kPi, 1)};
  Simulation simulation(scene, source);
  for (int n = 0; n < 300; ++n) {
    simulation.step();
    REQUIRE(simulation.statistics().joint_residual < 1e-10);
  }
  double last = 0;
  for (const Body& b : simulation.bodies()) {
    const Eigen::AngleAxisd turn(b.frame().rotation());
    CHECK(turn.angle() > last + 0.2);
    last = turn.angle();
  }
  CHECK(simulation.bodies()[2].frame().translation()[0] == Approx(0.5).epsilon(0.02));
}
