// Rigid limits: free fall, spin about a principal axis, torque-free tumbling. Printed figures are
// quoted in docs/accuracy/momentum.md, "Rigid motion".
#include "dynamics/body_output.hpp"
#include "dynamics/rotation.hpp"
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

const char* const kSchemes[] = {"radau2", "radau3", "bdf1", "bdf2", "theta:0.75"};

/// A body of one mesh, with its scene.
struct Case {
  BodyGeometry geometry;
  MemorySource source;
  Scene scene;
};

/// `tolerance`: of compression; 0 for none.
Case make_case(const TriangleMesh& mesh, const Material& m, const char* scheme, double lam,
               double tolerance = 0) {
  Case c;
  c.geometry = geometry_of(mesh, m.density);
  PrecomputeOptions o = options_for(c.geometry, m, scheme, lam);
  if (tolerance > 0) o.codec = CodecOptions(codec_named("lowrank"), tolerance);
  c.source.add("b", precompute(c.geometry, o));
  c.scene = one_body_scene(o.discretisation.dt);
  return c;
}

/// Attitude and angular velocity in body axes of a torque-free rigid body.
struct Tumbling {
  Mat3 rotation;
  Vec3 omega;
};

/// Euler's equations I w' = -w x I w, R' = R [w]_x by the classical Runge-Kutta method.
Tumbling integrate_euler(const Mat3& inertia, Vec3 omega, double time, int steps) {
  const Mat3 inverse = inertia.inverse();
  const auto rate = [&](const Tumbling& s) {
    return Tumbling{s.rotation * cross_matrix(s.omega),
                    inverse * -s.omega.cross(inertia * s.omega)};
  };
  const auto moved = [](const Tumbling& s, const Tumbling& d, double h) {
    return Tumbling{s.rotation + h * d.rotation, s.omega + h * d.omega};
  };
  Tumbling s{Mat3::Identity(), omega};
  const double h = time / steps;
  for (int n = 0; n < steps; ++n) {
    const Tumbling a = rate(s), b = rate(moved(s, a, h / 2)), c = rate(moved(s, b, h / 2)),
                   d = rate(moved(s, c, h));
    s = moved(moved(moved(moved(s, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    s.rotation = orthonormalised(s.rotation);
  }
  return s;
}

const Vec3 kBox(0.3, 0.2, 0.1), kAlmostIntermediate(0.05, 5, 0.05);

struct TumblingErrors {
  double attitude, momentum, energy;
};

/// Frame of the box after `time` against the reference; drift of |L| and of the rotational energy.
TumblingErrors tumble(const char* scheme, double time, int steps, const Mat3& reference) {
  const MassProperties mass = mass_properties(box(kBox, {1, 1, 1}), 1000);
  InitialMotion initial;
  initial.angular_velocity = kAlmostIntermediate;
  RigidFrame frame(Scheme::parse(scheme), time / steps, mass, initial, false);
  const Vec3 momentum = frame.angular_momentum();
  const auto energy = [&] {
    const Vec3 l = frame.rotation().transpose() * frame.angular_momentum();
    return 0.5 * l.dot(mass.inertia.inverse() * l);
  };
  const double start = energy();
  FrameLoads none;
  none.forces = none.torques = std::vector<Vec3>(Scheme::parse(scheme).stages(), Vec3::Zero());
  TumblingErrors e{0, 0, 0};
  for (int n = 0; n < steps; ++n) {
    frame.advance(frame.stages(none));
    e.momentum =
        std::max(e.momentum, (frame.angular_momentum() - momentum).norm() / momentum.norm());
    e.energy = std::max(e.energy, std::abs(energy() / start - 1));
  }
  e.attitude = (frame.rotation() - reference).norm() / std::sqrt(2);
  return e;
}

}  // namespace

TEST_CASE("free fall is exact, without deformation, in any units and anywhere") {
  const TriangleMesh body = bumpy_cube(0.2, 2, 0.2);
  for (const char* scheme : kSchemes)
    for (const double unit : {1.0, 1000.0})  // metres; millimetres
      for (const double distance : {0.0, 1e4}) {
        TriangleMesh mesh = body;
        for (Vec3& v : mesh.vertices) v *= unit;
        Case c = make_case(mesh, material(1000 / std::pow(unit, 3), 1e6 / unit, 0.3), scheme, 3.5);
        const Vec3 gravity = unit * Vec3(0.3, -9.81, 0), velocity = unit * Vec3(2, 5, -1);
        c.scene.gravity = gravity;
        c.scene.bodies[0].velocity = velocity;
        c.scene.bodies[0].position = unit * distance * Vec3(1, -1, 0.5);
        Simulation simulation(c.scene, c.source);
        const std::vector<Vec3> start = BodyOutput(simulation.bodies()[0]).positions();
        double error = 0, size = 0, deformation = 0;
        for (int n = 0; n < 1000; ++n) {
          simulation.step();
          const double t = simulation.time();
          const Vec3 moved = t * velocity + 0.5 * t * t * gravity;
          if (n % 100 == 99) {
            const std::vector<Vec3> x = BodyOutput(simulation.bodies()[0]).positions();
            for (std::size_t v = 0; v < x.size(); ++v)
              error = std::max(error, (x[v] - start[v] - moved).norm());
          }
          size = std::max(size, moved.norm() + unit * distance);
          deformation =
              std::max(deformation, simulation.bodies()[0].displacement().cwiseAbs().maxCoeff());
        }
        INFO(scheme << ", unit " << unit << ", distance " << distance);
        CHECK(error < 3e-13 * size);  // a thousand additions
        CHECK(deformation == 0);
      }
}

TEST_CASE("spin about a principal axis turns by the angle w t") {
  for (const char* scheme : kSchemes) {
    const double lam = std::string(scheme) == "radau3" ? 1.0 : 3.5;  // stable on this mesh
    Case c = make_case(box(kBox, {3, 2, 1}), material(1000, 1e7, 0.3), scheme, lam);
    c.scene.bodies[0].angular_velocity = Vec3(0, 0, 5);
    Simulation simulation(c.scene, c.source);
    for (int n = 0; n < 1000; ++n) simulation.step();
    const Mat3 exact = rotation_exp(Vec3(0, 0, 5 * simulation.time()));
    const double angle = (simulation.bodies()[0].frame().rotation() - exact).norm();
    const double stretch = simulation.bodies()[0].displacement().cwiseAbs().maxCoeff();
    std::printf("spin %s: %.1f turns, attitude error %.1e, lengthening %.1e m\n", scheme,
                5 * simulation.time() / (2 * kPi), angle, stretch);
    CHECK(angle < 1e-11);
    CHECK(stretch < 1e-6);
  }
}

TEST_CASE("compression leaves rigid motion exact") {
  // a push on one side and gravity: coarsely compressed, the body deforms a little differently, but
  // its frame goes the same way to the last digits
  for (const char* scheme : {"radau2", "theta:0.75"}) {
    std::vector<std::vector<Vec3>> ends;
    std::vector<RigidFrame> frames;
    double deformed = 0, difference = 0;
    for (const double tolerance : {0.0, 0.03}) {
      Case c = make_case(star(2, 0.4), material(1000, 1e6, 0.4), scheme, 3.5, tolerance);
      c.scene.gravity = Vec3(0, -9.81, 0);
      c.scene.bodies[0].angular_velocity = Vec3(0, 3, 0.2);
      TractionSpec push;
      push.select = box_selection(Vec3(0.2, -9, -9), Vec3(9, 9, 9));
      push.load = Vec3(20, 300, 10);
      push.follow = true;
      push.profile = {{0, 0}, {10 * c.scene.time_step, 1}, {20 * c.scene.time_step, 0}};
      c.scene.bodies[0].tractions.push_back(push);
      Simulation simulation(c.scene, c.source);
      const Body& body = simulation.bodies()[0];
      for (int n = 0; n < 300; ++n) {
        simulation.step();
        deformed = std::max(deformed, body.displacement().norm());
        if (n == 10) ends.emplace_back(BodyOutput(body).positions());
      }
      frames.push_back(body.frame());
    }
    for (std::size_t v = 0; v < ends[0].size(); ++v)
      difference = std::max(difference, (ends[0][v] - ends[1][v]).norm());
    const double moved = (frames[0].rotation() - frames[1].rotation()).norm();
    std::printf("%s, codec tolerance 0.03: frames differ by %.1e rad, positions by %.1e m\n",
                scheme, moved, difference);
    CHECK(difference > 1e-7);  // the deformation is not the same
    CHECK(moved < 1e-12);
    CHECK((frames[0].velocity() - frames[1].velocity()).norm() <
          1e-12 * frames[0].velocity().norm());
    CHECK(deformed > 1e-4);
  }
}

TEST_CASE("a box turned about its intermediate axis flips as Euler's equations say") {
  const Mat3 inertia = mass_properties(box(kBox, {1, 1, 1}), 1000).inertia;
  constexpr double kTime = 4;  // the first flip is over
  const Tumbling reference = integrate_euler(inertia, kAlmostIntermediate, kTime, 60000);
  const Tumbling coarser = integrate_euler(inertia, kAlmostIntermediate, kTime, 30000);
  REQUIRE((reference.rotation - coarser.rotation).norm() < 1e-11);
  REQUIRE(reference.omega[1] < -2);  // the body axis has turned over
  const std::pair<const char*, double> orders[] = {
      {"radau2", 3}, {"radau3", 5}, {"bdf1", 1}, {"bdf2", 2}, {"theta:0.75", 1}};
  for (const auto& [scheme, order] : orders) {
    std::vector<double> errors;
    const int first = order > 4 ? 75 : 600;  // before rounding
    for (const int steps : {first, 2 * first, 4 * first, 8 * first}) {
      const TumblingErrors e = tumble(scheme, kTime, steps, reference.rotation);
      errors.push_back(e.attitude);
      std::printf("tumbling %s, %d steps: attitude %.2e, momentum %.1e, energy %.1e\n", scheme,
                  steps, e.attitude, e.momentum, e.energy);
      CHECK(e.momentum < 1e-14);
    }
    INFO(scheme);
    CHECK(std::log2(errors[2] / errors[3]) == Approx(order).margin(0.25));
  }
}

TEST_CASE("a simulated body tumbles like its frame") {
  Case c = make_case(box(kBox, {3, 2, 1}), material(1000, 1e7, 0.3), "radau2", 1.5);
  c.scene.bodies[0].angular_velocity = kAlmostIntermediate;
  Simulation simulation(c.scene, c.source);
  const std::vector<Vec3> start = BodyOutput(simulation.bodies()[0]).positions();
  const Vec3 momentum = simulation.bodies()[0].frame().angular_momentum();
  const int steps = static_cast<int>(std::lround(3 / c.scene.time_step));
  for (int n = 0; n < steps; ++n) simulation.step();
  const Tumbling reference = integrate_euler(mass_properties(box(kBox, {1, 1, 1}), 1000).inertia,
                                             kAlmostIntermediate, simulation.time(), 60000);
  const std::vector<Vec3> x = BodyOutput(simulation.bodies()[0]).positions();
  double error = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    error = std::max(error, (x[v] - reference.rotation * start[v]).norm());
  const double drift =
      (simulation.bodies()[0].frame().angular_momentum() - momentum).norm() / momentum.norm();
  std::printf("tumbling body, %d steps of %.4f s: largest position error %.1e m, momentum %.1e\n",
              steps, c.scene.time_step, error, drift);
  CHECK(error < 1e-6);
  CHECK(drift < 1e-14);
}
