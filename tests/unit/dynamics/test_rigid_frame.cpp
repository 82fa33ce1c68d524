#include "dynamics/rigid_frame.hpp"
#include "dynamics/rotation.hpp"
#include "files/state_file.hpp"
#include "support/schemes.hpp"
#include "support/temporary_folder.hpp"

#include <random>
#include <string>

#include <catch2/catch.hpp>

using namespace bem;
using bem_test::kSchemes;

namespace {

constexpr double kMass = 2.5;

MassProperties mass_of_body() {
  MassProperties m;
  m.mass = kMass;
  m.inertia << 0.3, 0.02, -0.01, 0.02, 0.2, 0.03, -0.01, 0.03, 0.1;
  return m;
}

InitialMotion thrown() {
  InitialMotion m;
  m.centre = {1, -2, 0.5};
  m.rotation = rotation_exp({0.3, -0.7, 1.1});
  m.velocity = {3, 4, -1};
  m.angular_velocity = {1.5, -0.4, 2.2};
  m.gravity = {0.5, -9.81, 0.2};
  return m;
}

RigidFrame make_frame(const std::string& scheme, double dt, const InitialMotion& initial,
                      bool stationary = false) {
  return {Scheme::parse(scheme), dt, mass_of_body(), initial, stationary};
}

FrameLoads constant_loads(const std::string& scheme, const Vec3& force, const Vec3& torque) {
  const auto stages = static_cast<std::size_t>(Scheme::parse(scheme).stages());
  FrameLoads loads;
  loads.forces.assign(stages, force);
  loads.torques.assign(stages, torque);
  return loads;
}

Vec3 random_vector(std::mt19937_64& generator) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return {x, y, z};
}

FrameLoads random_loads(const std::string& scheme, std::mt19937_64& generator) {
  FrameLoads loads = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
  for (Vec3& f : loads.forces) f = random_vector(generator);
  for (Vec3& t : loads.torques) t = random_vector(generator);
  return loads;
}

/// Where a free body has turned to after one second in so many steps.
Mat3 tumbled(const std::string& scheme, int steps) {
  InitialMotion m = thrown();
  m.gravity.setZero();
  RigidFrame frame = make_frame(scheme, 1.0 / steps, m);
  const FrameLoads none = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
  for (int i = 0; i < steps; ++i) frame.advance(frame.stages(none));
  return frame.rotation();
}

}  // namespace

TEST_CASE("free fall is exact, in a moving and in a stationary frame") {
  const InitialMotion m = thrown();
  for (const std::string scheme : kSchemes)
    for (bool stationary : {false, true}) {
      INFO(scheme << (stationary ? " stationary" : ""));
      const double dt = 0.01;
      RigidFrame frame = make_frame(scheme, dt, m, stationary);
      const FrameLoads none = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
      for (int i = 0; i < 50; ++i) frame.advance(frame.stages(none));
      const double t = 50 * dt;
      CHECK(frame.time() == Approx(t));
      CHECK((frame.translation() - m.centre - t * m.velocity - 0.5 * t * t * m.gravity).norm() <
            1e-12);
      CHECK((frame.velocity() - m.velocity - t * m.gravity).norm() < 1e-12);
    }
}

TEST_CASE("a turn about a principal axis is exact") {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(mass_of_body().inertia);
  for (const std::string scheme : kSchemes) {
    INFO(scheme);
    InitialMotion m = thrown();
    m.angular_velocity = 3 * (m.rotation * axes.eigenvectors().col(1));
    RigidFrame frame = make_frame(scheme, 0.02, m);
    const FrameLoads none = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
    for (int i = 0; i < 40; ++i) frame.advance(frame.stages(none));
    const Mat3 expected = rotation_exp(0.8 * m.angular_velocity) * m.rotation;
    CHECK((frame.rotation() - expected).norm() < 1e-12);
  }
}

TEST_CASE("a free body tumbles with the order of the scheme and keeps its angular momentum") {
  const Mat3 exact = tumbled("radau3", 200);
  CHECK((exact.transpose() * exact - Mat3::Identity()).norm() < 1e-14);
  for (const auto& [scheme, order] :
       {std::pair<const char*, int>{"bdf1", 1}, {"bdf2", 2}, {"radau2", 3}, {"radau3", 5}}) {
    const double coarse = (tumbled(scheme, 20) - exact).norm(),
                 fine = (tumbled(scheme, 40) - exact).norm();
    INFO(scheme << ": errors " << coarse << ", " << fine);
    CHECK(coarse < 1);
    CHECK(std::log2(coarse / fine) > order - 0.4);
    CHECK(std::log2(coarse / fine) < order + 0.8);
  }
  InitialMotion m = thrown();
  RigidFrame frame = make_frame("radau2", 0.05, m);
  const Vec3 before = frame.angular_momentum();
  CHECK((before - m.rotation * mass_of_body().inertia * m.rotation.transpose() * m.angular_velocity)
            .norm() < 1e-14);
  const FrameLoads none = constant_loads("radau2", Vec3::Zero(), Vec3::Zero());
  for (int i = 0; i < 100; ++i) frame.advance(frame.stages(none));
  CHECK((frame.angular_momentum() - before).norm() == 0);
}

TEST_CASE("velocities are the differences of places, angular momenta those of rotations") {
  for (const std::string scheme : {"radau2", "radau3"}) {
    INFO(scheme);
    const double dt = 1e-3;
    RigidFrame frame = make_frame(scheme, dt, thrown());
    const FrameLoads loads = constant_loads(scheme, {1, -3, 2}, {0.1, 0.3, -0.2});
    for (int i = 0; i < 10; ++i) frame.advance(frame.stages(loads));
    const Vec3 x = frame.translation();
    const Mat3 r = frame.rotation();
    frame.advance(frame.stages(loads));
    const Vec3 velocity = frame.velocity(), momentum = frame.angular_momentum();
    const Mat3 turned = frame.rotation();
    frame.advance(frame.stages(loads));
    // under a constant force the place is a parabola, of which central differences are exact
    CHECK(((frame.translation() - x) / (2 * dt) - velocity).norm() < 1e-10);
    const Vec3 omega = rotation_log(frame.rotation() * r.transpose()) / (2 * dt);
    const Mat3 inertia = turned * mass_of_body().inertia * turned.transpose();
    CHECK((inertia * omega - momentum).norm() < 1e-5 * momentum.norm());
  }
}

TEST_CASE("every step changes the momenta by the impulses of its loads") {
  std::mt19937_64 generator(5);
  for (const std::string scheme : kSchemes)
    for (bool stationary : {false, true}) {
      INFO(scheme << (stationary ? " stationary" : ""));
      RigidFrame frame = make_frame(scheme, 0.01, thrown(), stationary);
      for (int i = 0; i < 20; ++i) {
        FrameLoads loads = random_loads(scheme, generator);
        if (i % 3 == 1) {
          loads.impulse = random_vector(generator);
          loads.angular_impulse = random_vector(generator);
        }
        const Vec3 momentum = frame.momentum(), spin = frame.spin();
        frame.advance(frame.stages(loads));
        const Vec3 weight = 0.01 * kMass * frame.gravity();
        CHECK(
            (frame.momentum() - momentum - frame.impulse_of(loads.forces) - loads.impulse - weight)
                .norm() < 1e-12);
        CHECK(
            (frame.spin() - spin - frame.impulse_of(loads.torques) - loads.angular_impulse).norm() <
            1e-13);
      }
    }
}

TEST_CASE("an impulse is a jump of the velocities") {
  for (const std::string scheme : kSchemes) {
    INFO(scheme);
    InitialMotion m = thrown();
    m.gravity.setZero();
    m.angular_velocity.setZero();
    const double dt = 0.01;
    RigidFrame frame = make_frame(scheme, dt, m);
    FrameLoads loads = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
    loads.impulse = {1, 2, -3};
    frame.advance(frame.stages(loads));
    loads.impulse.setZero();
    for (int i = 0; i < 9; ++i) frame.advance(frame.stages(loads));
    const Vec3 after = m.velocity + Vec3(1, 2, -3) / kMass;
    CHECK((frame.velocity() - after).norm() < 1e-13);
    CHECK((frame.translation() - m.centre - 10 * dt * after).norm() < 1e-13);
  }
}

TEST_CASE("position_by_acceleration is the derivative of the places by the forces") {
  for (const std::string scheme : kSchemes) {
    RigidFrame frame = make_frame(scheme, 0.01, thrown());
    const FrameLoads none = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
    frame.advance(frame.stages(none));
    const StageMatrix derivative = frame.position_by_acceleration();
    const auto before = frame.stages(none);
    for (Eigen::Index j = 0; j < derivative.cols(); ++j) {
      FrameLoads loads = none;
      loads.forces[static_cast<std::size_t>(j)] = {0, kMass, 0};
      const auto after = frame.stages(loads);
      for (Eigen::Index i = 0; i < derivative.rows(); ++i) {
        const auto stage = static_cast<std::size_t>(i);
        INFO(scheme << " stage " << i << " by force " << j);
        CHECK((after.translation[stage] - before.translation[stage] - Vec3(0, derivative(i, j), 0))
                  .norm() < 1e-14);
      }
    }
  }
}

TEST_CASE("points of the body keep their distances in a moving frame") {
  RigidFrame frame = make_frame("radau2", 0.05, thrown());
  const FrameLoads loads = constant_loads("radau2", {1, 2, 3}, {0.3, -0.1, 0.2});
  for (int i = 0; i < 20; ++i) frame.advance(frame.stages(loads));
  const Vec3 x(0.3, -0.2, 0.1), u(0.01, 0.02, -0.03);
  const auto now = frame.current();
  CHECK((frame.place(now, 0, Vec3::Zero(), Vec3::Zero()) - frame.translation()).norm() < 1e-14);
  // back to the axes of the body
  const Vec3 placed = frame.place(now, 0, x, u);
  CHECK((frame.rotation().transpose() * (placed - frame.translation()) - x - u).norm() < 1e-13);
}

TEST_CASE("a stationary frame turns to first order") {
  const InitialMotion m = thrown();
  for (const std::string scheme : {"radau2", "radau3"}) {
    const double dt = 0.01, t = 20 * dt;
    const Vec3 torque(0.3, -0.1, 0.2), x(0.3, -0.2, 0.1), u(0.01, 0.02, -0.03);
    RigidFrame frame = make_frame(scheme, dt, m, true);
    const FrameLoads loads = constant_loads(scheme, Vec3::Zero(), torque);
    for (int i = 0; i < 20; ++i) frame.advance(frame.stages(loads));
    CHECK((frame.rotation() - m.rotation).norm() < 1e-14);
    const Mat3 inverse = m.rotation * mass_of_body().inertia.inverse() * m.rotation.transpose();
    const Vec3 turn = t * m.angular_velocity + 0.5 * t * t * inverse * torque;
    const Vec3 expected =
        frame.translation() + m.rotation * (x + u) + turn.cross(Vec3(m.rotation * x));
    CHECK((frame.place(frame.current(), 0, x, u) - expected).norm() < 1e-12);
  }
}

TEST_CASE("a frame without inertia moves by its mobility times force over mass") {
  InitialMotion m = thrown();
  RigidFrame frame = make_frame("bdf1", 0.01, m, true);
  frame.set_mobility(7.0);
  CHECK(frame.position_by_acceleration()(0, 0) == 7.0);
  const Vec3 force(1, -3, 2), torque(0.1, 0.3, -0.2), x(0.3, -0.2, 0.1);
  const auto s = frame.stages(constant_loads("bdf1", force, torque));
  const Vec3 way = 7 * (force / kMass + m.gravity);
  CHECK((s.translation[0] - m.centre - way).norm() < 1e-13);
  const Mat3 inverse = m.rotation * mass_of_body().inertia.inverse() * m.rotation.transpose();
  CHECK((s.turn[0] - 7 * inverse * torque).norm() < 1e-12);
}

TEST_CASE("drag is that of a critically damped oscillator, and its force what it takes away") {
  for (const auto& [scheme, order] :
       {std::pair<const char*, int>{"bdf1", 1}, {"radau2", 3}, {"radau3", 5}}) {
    InitialMotion m;
    m.centre = {1, 0, 0};
    m.velocity = {0, 2, 0};
    const double w = 3;
    double error[2];
    for (int k = 0; k < 2; ++k) {
      const int steps = 20 << k;
      const double dt = 1.0 / steps;
      RigidFrame frame = make_frame(scheme, dt, m);
      const FrameLoads none = constant_loads(scheme, Vec3::Zero(), Vec3::Zero());
      FrameDrag drag;
      drag.rate = w;
      const std::size_t stages = none.forces.size();
      drag.centre = drag.velocity = drag.angular_velocity = drag.lean =
          std::vector<Vec3>(stages, Vec3::Zero());
      drag.rotation.assign(stages, Mat3::Identity());
      for (int i = 0; i < steps; ++i) {
        const Vec3 momentum = frame.momentum();
        const auto s = frame.stages(none, drag);
        frame.advance(s);
        CHECK((frame.momentum() - momentum - frame.impulse_of(s.drag)).norm() < 1e-12);
      }
      const Vec3 exact = std::exp(-w) * (m.centre * (1 + w) + m.velocity);
      error[k] = (frame.translation() - exact).norm();
    }
    INFO(scheme << ": errors " << error[0] << ", " << error[1]);
    CHECK(error[0] < 0.1);
    CHECK(std::log2(error[0] / error[1]) > order - 0.4);
  }
}

TEST_CASE("a frame that is restarted goes on as before, and then falls by its own gravity") {
  const Vec3 other(1, 2, 3);
  for (const char* scheme : kSchemes) {
    for (bool same : {true, false}) {
      INFO(scheme << ", same gravity: " << same);
      RigidFrame frame = make_frame(scheme, 0.01, thrown());
      const FrameLoads loads = constant_loads(scheme, {1, -2, 3}, {0.1, 0.2, -0.1});
      for (int n = 0; n < 5; ++n) frame.advance(frame.stages(loads));
      RigidFrame next = frame;  // or one that is made for another gravity and takes its state
      if (!same) {
        InitialMotion motion = thrown();
        motion.gravity = other;
        next = make_frame(scheme, 0.01, motion);
        const test::TemporaryFolder folder("frame");
        StateWriter writer(folder / "s");
        writer(frame);
        writer.commit();
        StateReader reader(folder / "s");
        reader(next);
      }
      next.restart(thrown().gravity);
      CHECK(next.time() == 0);
      CHECK((next.translation() - frame.translation()).norm() < 1e-14);
      CHECK((next.velocity() - frame.velocity()).norm() < 1e-13);
      if (same) {
        for (int n = 0; n < 5; ++n) frame.advance(frame.stages(loads));
        for (int n = 0; n < 5; ++n) next.advance(next.stages(loads));
        CHECK(next.translation() == frame.translation());
        CHECK(next.rotation() == frame.rotation());
        continue;
      }
      // what is not gravity goes on, so that the difference to the first is that of two falls
      for (int n = 0; n < 5; ++n) frame.advance(frame.stages(loads));
      for (int n = 0; n < 5; ++n) next.advance(next.stages(loads));
      const double t = next.time();
      const Vec3 fall = 0.5 * t * t * (other - thrown().gravity);
      CHECK((next.translation() - frame.translation() - fall).norm() < 1e-13);
      CHECK((next.velocity() - frame.velocity() - t * (other - thrown().gravity)).norm() < 1e-12);
      CHECK((next.momentum() - frame.momentum() - kMass * t * (other - thrown().gravity)).norm() <
            1e-12);
    }
  }
}
