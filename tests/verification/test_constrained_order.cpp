// Order of convergence in time with handles and joints, against that of a free body; space is
// fixed. Printed figures are quoted in docs/accuracy/contact.md, "Order in time with
// handles and joints".
#include "dynamics/body_output.hpp"
#include "support/contact_scenes.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kSpeed = 10;                        // of shear waves [m/s]
constexpr double kRadius = 0.1;                      // of every body [m]
constexpr double kDuration = 24 * kRadius / kSpeed;  // [s]
/// Place of two vertices with different y on the sphere, at z = 0.
const Vec3 kJoint = kRadius * Vec3(1, 0.5 * (1 + std::sqrt(5.0)), 0).normalized();

/// Rises from zero, with five derivatives, to one and back.
double pulse(double t) {
  return std::pow(std::sin(kPi * t / (1.2 * kDuration)), 6);
}

/// Times so close that interpolation between them is as good as exact.
std::vector<double> fine_times() {
  std::vector<double> out;
  constexpr int kCount = 30000;
  for (int i = 0; i <= kCount; ++i) out.push_back(1.01 * kDuration * i / kCount);
  return out;
}

/// The part of a body around the origin that is farthest to one side.
Selection cap(double side) {
  return side > 0 ? box_selection(Vec3(0.5 * kRadius, -1, -1), Vec3(1, 1, 1))
                  : box_selection(Vec3(-1, -1, -1), Vec3(-0.5 * kRadius, 1, 1));
}

TractionSpec cap_load(double side) {
  TractionSpec load;
  load.select = cap(side);
  load.load = Vec3(300, 150, 60);
  for (double t : fine_times()) load.profile.push_back({t, pulse(t)});
  return load;
}

HandleSpec moved_cap(double side) {
  HandleSpec handle;
  handle.select = cap(side);
  for (double t : fine_times()) {
    Keyframe k;
    k.time = t;
    k.translate = 0.02 * pulse(t) * Vec3(1, 0.5, 0.2);
    handle.motion.push_back(k);
  }
  return handle;
}

JointSpec joint(JointType type, const Vec3& point) {
  JointSpec j;
  j.type = type;
  j.a.body = 0;
  j.a.point = point;
  j.b = JointEnd{1, point, {}};
  if (type == JointType::weld) j.tolerance = 0.5 * kRadius;
  return j;
}

enum class Problem { free, handle, fixed, point, weld };

const char* name_of(Problem problem) {
  switch (problem) {
    case Problem::free:
      return "free";
    case Problem::handle:
      return "handle";
    case Problem::fixed:
      return "fixed";
    case Problem::point:
      return "point joints";
    case Problem::weld:
      break;
  }
  return "weld";
}

Scene scene_of(Problem problem, double dt) {
  Scene scene;
  scene.time_step = dt;
  scene.bodies = {body("a", "ball", Vec3(0, 0, 0))};
  BodySpec& first = scene.bodies[0];
  switch (problem) {
    case Problem::free:
      first.tractions = {cap_load(1)};
      break;
    case Problem::handle:
      first.handles = {moved_cap(-1)};
      break;
    case Problem::fixed:
      first.fixed = {cap(-1)};
      first.tractions = {cap_load(1)};
      break;
    case Problem::point:
    case Problem::weld:
      first.tractions = {cap_load(-1)};
      scene.bodies.push_back(body("b", "ball", Vec3(2 * kJoint[0], 0, 0)));
      if (problem == Problem::weld)
        scene.joints = {joint(JointType::weld, Vec3::Zero())};  // of several pairs, some apart
      else
        scene.joints = {joint(JointType::point, kJoint),
                        joint(JointType::point, kJoint.cwiseProduct(Vec3(1, -1, 1)))};
  }
  return scene;
}

/// One time step and the model made for it.
struct Run {
  Run(const char* scheme, int step_count) : steps(step_count), dt(kDuration / step_count) {
    const BodyGeometry g = geometry_of(icosphere(1, kRadius), 1000);
    const Material m = material(1000, 1000 * kSpeed * kSpeed, 0.3);
    PrecomputeOptions o = options_for(g, m, scheme, g.extent / (kSpeed * dt));
    o.discretisation.dt = dt;
    o.discretisation.history_length *= 3;  // a shorter one has an error of its own
    source.add("ball", precompute(g, o));
  }

  /// Positions of all nodes at eight times [m].
  Eigen::VectorXd positions(Problem problem) {
    Simulation simulation(scene_of(problem, dt), source);
    std::vector<double> out;
    for (int n = 1; n <= steps; ++n) {
      simulation.step();
      REQUIRE(simulation.statistics().converged());
      if (n % (steps / 8) != 0) continue;
      for (const Body& b : simulation.bodies())
        for (const Vec3& x : BodyOutput(b).positions())
          out.insert(out.end(), x.data(), x.data() + 3);
    }
    return Eigen::Map<Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
  }

  int steps;
  double dt;
  MemorySource source;
};

/// With every scheme and problem, the order that changes of the result fall with when the step is
/// halved, the last time to `most_steps`, half of them for order five.
void check_orders(int most_steps) {
  const std::pair<const char*, double> schemes[] = {
      {"radau2", 2.7}, {"radau3", 4.4}, {"bdf2", 1.75}, {"theta:0.75", 0.75}, {"bdf1", 0.75}};
  for (const auto& [scheme, least] : schemes) {
    const int steps = least > 4 ? most_steps / 2 : most_steps;
    Run coarse(scheme, steps / 4), middle(scheme, steps / 2), fine(scheme, steps);
    for (Problem problem :
         {Problem::free, Problem::fixed, Problem::handle, Problem::point, Problem::weld}) {
      const Eigen::VectorXd x = middle.positions(problem);
      const double before = (x - coarse.positions(problem)).norm();
      const double change = (fine.positions(problem) - x).norm();
      const double order = std::log2(before / change);
      std::printf("%-10s %-12s %d steps: change %.1e m, order %.2f\n", scheme, name_of(problem),
                  steps, change / std::sqrt(static_cast<double>(x.size())), order);
      INFO(scheme << ", " << name_of(problem));
      CHECK(order > least);
    }
  }
}

}  // namespace

TEST_CASE("handles and joints keep the order of the time discretisation") {
  check_orders(128);
}

TEST_CASE("handles and joints keep the order: shorter steps", "[.][long]") {
  check_orders(256);
}
