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

TEST_CASE("flat drop of a cube: contact time, force and rebound") {
  const DropRun coarse = drop_cube("radau2", 4, 40);
  CHECK(coarse.momentum < 1e-12);
  drop_cube("bdf1", 4, 40);
}

namespace {

/// A rigid body's model.
BodyModel rigid_model(TriangleMesh mesh, double density) {
  PrecomputeOptions o;
  o.kind = ModelKind::rigid;
  o.discretisation.material = material(density, 1e6, 0.3);
  return precompute(geometry_of(std::move(mesh), density), o);
}

BodyModel elastic_model(TriangleMesh mesh, const Material& m, double dt) {
  const BodyGeometry g = geometry_of(std::move(mesh), m.density);
  PrecomputeOptions o = options_for(g, m, "radau2", g.extent / (m.shear_speed() * dt));
  o.discretisation.dt = dt;
  return precompute(g, o);
}

BodySpec body(const std::string& name, const std::string& archive, const Vec3& position) {
  BodySpec b;
  b.name = name;
  b.archive.resolved = b.archive.written = archive;
  b.position = position;
  return b;
}

}  // namespace

TEST_CASE("a rigid box falls, stays down and slides to rest") {
  MemorySource source;
  source.add("box", rigid_model(box(Vec3(0.4, 0.4, 0.1), {2, 2, 1}), 1000));
  Scene scene;
  scene.time_step = 1e-3;
  scene.gravity = Vec3(0, 0, -9.81);
  scene.bodies = {body("b", "box", Vec3(0, 0, 0.06))};
  scene.bodies[0].velocity = Vec3(1, 0, 0);
  scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.4)};
  scene.contact.enabled = true;
  Simulation simulation(scene, source);
  double highest = 0;
  for (int n = 0; n < 500; ++n) {
    simulation.step();
    const Body& b = simulation.bodies()[0];
    if (n > 60) highest = std::max(highest, b.frame().translation()[2]);
    if (n % 25 == 0) std::printf("%d %.6f %.6f v %.5f %.5f contacts %d\n", n, b.frame().translation()[0],
                b.frame().translation()[2], b.frame().velocity()[0], b.frame().velocity()[2], simulation.statistics().contacts);
  }
  CHECK(highest == Approx(0.05).epsilon(1e-5));
  const double fall = std::sqrt(2 * 0.01 / 9.81);  // no friction before; a push while it lands
  const double speed = 1 - 0.4 * 9.81 * fall;
  CHECK(simulation.bodies()[0].frame().translation()[0] ==
        Approx(fall + speed * speed / (2 * 0.4 * 9.81)).epsilon(0.01));
}

TEST_CASE("two elastic balls collide head on") {
  const Material m = material(1000, 1e6, 0.3);
  const double dt = 2e-4;
  for (double ratio : {1.0, 2.0}) {
    MemorySource source;
    source.add("ball", elastic_model(icosphere(2, 0.05), m, dt));
    TriangleMesh other = icosphere(2, 0.05 * ratio);
    source.add("other", elastic_model(std::move(other), m, dt));
    Scene scene;
    scene.time_step = dt;
    scene.bodies = {body("a", "ball", Vec3(-0.051, 0, 0)), body("b", "other", Vec3(0.05 * ratio, 0, 0))};
    scene.bodies[0].velocity = Vec3(1, 0, 0);
    scene.contact.enabled = true;
    Simulation simulation(scene, source);
    double momentum = 0;
    int touching = 0;
    for (int n = 0; n < 300; ++n) {
      simulation.step();
      touching += simulation.statistics().contacts > 0;
      const Vec3 p = simulation.bodies()[0].linear_momentum() + simulation.bodies()[1].linear_momentum();
      momentum = std::max(momentum, (p - simulation.bodies()[0].frame().mass() * Vec3(1, 0, 0)).norm());
    }
    const Vec3 va = simulation.bodies()[0].frame().velocity(), vb = simulation.bodies()[1].frame().velocity();
    std::printf("balls ratio %.0f: va %.4f %.4f %.4f vb %.4f %.4f %.4f touching %d momentum %.2g\n", ratio, va[0], va[1], va[2],
                vb[0], vb[1], vb[2], touching, momentum);
    CHECK(momentum < 1e-12);
  }
}

TEST_CASE("a stack of cubes stands") {
  const Material m = material(1000, 1e6, 0.3);
  const double dt = 2e-3;
  for (bool rigid : {true, false}) {
    MemorySource source;
    source.add("cube", rigid ? rigid_model(box(Vec3(0.2, 0.2, 0.2), {2, 2, 2}), 1000)
                             : elastic_model(box(Vec3(0.2, 0.2, 0.2), {2, 2, 2}), m, dt));
    Scene scene;
    scene.time_step = dt;
    scene.gravity = Vec3(0, 0, -9.81);
    for (int i = 0; i < 5; ++i) {
      scene.bodies.push_back(body("c" + std::to_string(i), "cube", Vec3(0, 0, 0.1 + 0.2 * i)));
      scene.bodies.back().friction = 0.5;
    }
    scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.5)};
    scene.contact.enabled = true;
    Simulation simulation(scene, source);
    for (int n = 0; n < 1000; ++n) {
      simulation.step();
      const Vec3 x = simulation.bodies()[4].frame().translation();
      if (n % 100 == 0 || n < 5)
        std::printf("stack rigid %d %d: top %.2e %.2e %.6f v %.2e contacts %d it %d sweeps %d newton %d err %.2g pen %.2g conv %d\n", rigid, n, x[0], x[1],
                    x[2], simulation.bodies()[4].frame().velocity().norm(),
                    simulation.statistics().contacts, simulation.statistics().iterations, simulation.statistics().sweeps,
                    simulation.statistics().newton_steps, simulation.statistics().contact_error, simulation.statistics().penetration, simulation.statistics().converged);
    }
  }
}

TEST_CASE("a chain of bodies hangs by point joints") {
  const Material m = material(1000, 1e6, 0.3);
  const double dt = 2e-3;
  for (bool rigid : {true, false}) {
    MemorySource source;
    source.add("link", rigid ? rigid_model(box(Vec3(0.2, 0.05, 0.05), {4, 2, 2}), 1000)
                             : elastic_model(box(Vec3(0.2, 0.05, 0.05), {4, 2, 2}), m, dt));
    Scene scene;
    scene.time_step = dt;
    scene.gravity = Vec3(0, 0, -9.81);
    for (int i = 0; i < 10; ++i)
      scene.bodies.push_back(body("l" + std::to_string(i), "link", Vec3(0.1 + 0.2 * i, 0, 0)));
    for (int i = 0; i < 10; ++i) {
      JointSpec j;
      j.a.body = i;
      j.a.point = Vec3(0.2 * i, 0, 0);
      if (i > 0) {
        j.b.emplace();
        j.b->body = i - 1;
        j.b->point = j.a.point;
      }
      scene.joints.push_back(j);
    }
    Simulation simulation(scene, source);
    const double mass = simulation.bodies()[0].frame().mass();
    for (int n = 0; n < 1000; ++n) {
      simulation.step();
      double energy = 0;
      for (const Body& b : simulation.bodies())
        energy += 0.5 * mass * b.frame().velocity().squaredNorm() + mass * 9.81 * b.frame().translation()[2];
      const Vec3 x = simulation.bodies()[9].frame().translation();
      if (n % 100 == 0)
        std::printf("chain rigid %d %d: end %.4f %.4f %.4f energy %.4f it %d residual %.2g conv %d\n", rigid, n,
                    x[0], x[1], x[2], energy, simulation.statistics().iterations,
                    simulation.statistics().joint_residual, simulation.statistics().converged);
    }
  }
}

TEST_CASE("a beam of welded cubes is twisted by its ends") {
  const Material m = material(1000, 1e6, 0.3);
  const double dt = 2e-3;
  MemorySource source;
  source.add("cube", elastic_model(box(Vec3(0.2, 0.2, 0.2), {3, 3, 3}), m, dt));
  Scene scene;
  scene.time_step = dt;
  for (int i = 0; i < 5; ++i)
    scene.bodies.push_back(body("c" + std::to_string(i), "cube", Vec3(0.1 + 0.2 * i, 0, 0)));
  for (int i = 0; i < 4; ++i) {
    JointSpec j;
    j.type = JointType::weld;
    j.a.body = i;
    j.b.emplace();
    j.b->body = i + 1;
    scene.joints.push_back(j);
  }
  const auto handle = [](double x, double turn) {
    HandleSpec h;
    h.select = box_selection(Vec3(x - 1e-3, -1, -1), Vec3(x + 1e-3, 1, 1));
    Keyframe start, end;
    end.time = 1;
    end.rotate.axis = Vec3::UnitX();
    end.rotate.angle = turn;
    h.motion = {start, end};
    return h;
  };
  constexpr double kPi = 3.14159265358979323846;
  scene.bodies[0].handles = {handle(-0.1, 0)};
  scene.bodies[4].handles = {handle(0.1, kPi)};
  Simulation simulation(scene, source);
  for (int n = 0; n < 700; ++n) {
    simulation.step();
    if (n % 50 != 0) continue;
    std::printf("twist %d: it %d residual %.2g conv %d x", n, simulation.statistics().iterations,
                simulation.statistics().joint_residual, simulation.statistics().converged);
    for (const Body& b : simulation.bodies()) {
      const Eigen::AngleAxisd r(b.frame().rotation());
      std::printf(" %.1f", r.angle() * 180 / kPi);
    }
    std::printf(" mid %.5f %.5f\n", simulation.bodies()[2].frame().translation()[1], simulation.bodies()[2].frame().translation()[2]);
  }
}
