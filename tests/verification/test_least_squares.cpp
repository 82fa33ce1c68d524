// The paper's correction beside the projection: momentum and deformation after a push. Printed
// figures are quoted in docs/accuracy/momentum.md, "The paper's correction".
#include "dynamics/body_output.hpp"
#include "model/rigid_projection.hpp"
#include "support/simulate.hpp"

#include <cstdio>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

struct Push {
  const char* name;
  TriangleMesh mesh;
  Vec3 traction;  ///< on the face of largest x, for five steps [Pa]
};

constexpr double kLam = 3.5;
constexpr int kPushed = 5, kSteps = 60;

struct Outcome {
  double velocity = 0;          ///< along the push, over impulse / mass
  double spin = 0;              ///< about z, over angular impulse / inertia
  Eigen::VectorXd deformation;  ///< without rigid motion, at the end of the push [m]
  bool calm = false;            ///< the deformation has decayed at the end
};

Eigen::VectorXd without_rigid_motion(const Body& body) {
  const TriangleMesh& mesh = body.model().geometry.nodes;
  Eigen::VectorXd u = body.displacement();
  const Eigen::VectorXd motion = rigid_part(mesh) * u;
  u -= translations(mesh) * motion.head<3>() + rotations(mesh) * motion.tail<3>();
  return u;
}

Outcome run(const Push& push, Correction correction) {
  const Material m = material(1000, 1e6, 0.3);
  const BodyGeometry g = geometry_of(push.mesh, m.density);
  const PrecomputeOptions o = options_for(g, m, "bdf1", kLam);
  const double dt = o.discretisation.dt;
  MemorySource source;
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(dt);
  scene.bodies[0].correction = correction;
  double high = 0;
  for (const Vec3& x : g.nodes.vertices) high = std::max(high, x[0]);
  TractionSpec load;
  load.select = box_selection(Vec3(high - 1e-6, -9, -9), Vec3(high + 1e-6, 9, 9));
  load.load = push.traction;
  load.profile = {{0, 1}, {kPushed * dt, 1}, {(kPushed + 0.001) * dt, 0}};
  scene.bodies[0].tractions.push_back(load);
  Simulation simulation(scene, source);
  Outcome out;
  for (int n = 0; n < kSteps; ++n) {
    simulation.step();
    if (n + 1 == kPushed) out.deformation = without_rigid_motion(simulation.bodies()[0]);
  }
  const Body& body = simulation.bodies()[0];
  double area = 0;
  for (const Triangle& t : g.nodes.triangles)
    if (triangle_centroid(g.nodes, t)[0] > high - 1e-6) area += triangle_area(g.nodes, t);
  const Vec3 impulse = kPushed * dt * area * push.traction;
  out.velocity = body.frame().velocity().dot(impulse) / impulse.squaredNorm() * g.mass.mass;
  const double turned = high * impulse[1];
  if (turned != 0) out.spin = body.frame().angular_momentum()[2] / turned;
  out.calm = without_rigid_motion(body).norm() < 1e-3 * out.deformation.norm();
  return out;
}

}  // namespace

TEST_CASE("the paper's correction gives the frame a wrong momentum, the projection the right one") {
  const TriangleMesh rod = box(Vec3(2, 0.5, 0.5), {8, 2, 2}), cube = box(Vec3(1, 1, 1), {4, 4, 4});
  const Push pushes[] = {{"rod, axial", rod, Vec3(1, 0, 0)},
                         {"rod, transverse", rod, Vec3(0, 1, 0)},
                         {"cube, axial", cube, Vec3(1, 0, 0)},
                         {"cube, transverse", cube, Vec3(0, 1, 0)}};
  for (const Push& push : pushes) {
    const Outcome linear = run(push, Correction::projection);
    const Outcome paper = run(push, Correction::least_squares);
    const double apart =
        (paper.deformation - linear.deformation).norm() / linear.deformation.norm();
    std::printf("%s: velocity %.4f and %.4f, spin %.4f and %.4f, deformations differ by %.1e\n",
                push.name, linear.velocity, paper.velocity, linear.spin, paper.spin, apart);
    INFO(push.name);
    CHECK(std::abs(linear.velocity - 1) < 1e-9);
    CHECK(paper.velocity > 1.003);
    CHECK(paper.velocity < 1.2);
    CHECK(apart < 0.02);
    CHECK(paper.calm);
  }
}

TEST_CASE("bodies corrected by least squares can be held and touched") {
  const Material m = material(1000, 1e6, 0.3);
  const TriangleMesh mesh = box(Vec3(0.4, 0.2, 0.2), {4, 2, 2});
  const BodyGeometry g = geometry_of(mesh, m.density);
  const PrecomputeOptions o = options_for(g, m, "bdf1", 2);
  MemorySource source;
  source.add("b", precompute(g, o));
  Scene scene = one_body_scene(o.discretisation.dt);
  scene.gravity = Vec3(0, -9.81, 0);
  scene.bodies[0].fixed.push_back(
      box_selection(Vec3(-0.2 - 1e-6, -1, -1), Vec3(-0.2 + 1e-6, 1, 1)));
  double sag[2];
  for (const Correction correction : {Correction::projection, Correction::least_squares}) {
    scene.bodies[0].correction = correction;
    Simulation simulation(scene, source);
    for (int n = 0; n < 300; ++n) simulation.step();
    const std::vector<Vec3> x = BodyOutput(simulation.bodies()[0]).positions();
    double& lowest = sag[correction == Correction::least_squares];
    lowest = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
      lowest = std::max(lowest, mesh.vertices[v][1] - x[v][1]);
  }
  std::printf("held beam sags by %.5e, corrected as in the paper by %.5e\n", sag[0], sag[1]);
  // in equilibrium, too, its forces are those that would give the wrong momentum
  CHECK(sag[1] < 0.95 * sag[0]);
  CHECK(sag[1] > 0.75 * sag[0]);
}
