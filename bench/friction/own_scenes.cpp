#include "own_scenes.hpp"

#include "base/error.hpp"
#include "support/contact_scenes.hpp"

namespace bem {
namespace {

using namespace bem_test;

constexpr double kTimeStep = 2e-3;
const Vec3 kGravity(0, 0, -9.81);

Material soft(double density) {
  return material(density, 1e3 * density, 0.3);
}

OwnScene made(std::string name, int steps, const Scene& scene, MemorySource& source) {
  return {std::move(name), steps, std::make_unique<Simulation>(scene, source)};
}

/// A block with cells x cells cells below slides on a plane or on a sheet of small triangles.
OwnScene sliding_block(bool rigid, int cells, bool on_sheet, int steps) {
  MemorySource source;
  const TriangleMesh mesh = box(Vec3(0.4, 0.4, 0.1), {cells, cells, 1});
  source.add("block", rigid ? rigid_model(mesh, 1000) : elastic_model(mesh, soft(1000), kTimeStep));
  Scene scene = contact_scene(kTimeStep, kGravity);
  scene.bodies = {body("block", "block", Vec3(-0.3, 0, 0.05))};
  scene.bodies[0].friction = 0.4;
  scene.bodies[0].velocity = Vec3(2, 0.4, 0);
  if (on_sheet) {
    source.add_obstacle("sheet", sheet(2, 83));
    scene.obstacles = {mesh_obstacle("sheet", 0.4)};
  } else {
    scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.4)};
  }
  const std::string size = std::to_string(cells) + " x " + std::to_string(cells);
  return made((rigid ? "rigid block " : "block ") + size + (on_sheet ? " on triangles" : ""), steps,
              scene, source);
}

OwnScene rolling_ball(int steps) {
  MemorySource source;
  source.add("ball", elastic_model(icosphere(3, 0.1), material(1000, 1e5, 0.3), 2 * kTimeStep));
  source.add_obstacle("sheet", sheet(2, 83));
  Scene scene = contact_scene(2 * kTimeStep, 3 * kGravity);
  scene.bodies = {body("ball", "ball", Vec3(-0.5, 0, 0.1))};
  scene.bodies[0].friction = 0.6;
  scene.bodies[0].velocity = Vec3(1, 0.3, 0);
  scene.bodies[0].angular_velocity = Vec3(-3, 10, 0);
  scene.obstacles = {mesh_obstacle("sheet", 0.6)};
  return made("ball rolling on triangles", steps, scene, source);
}

/// Cubes of 0.2 m on top of each other, pushed from the side by gravity.
OwnScene stack(bool rigid, int count, int cells, int steps) {
  MemorySource source;
  const TriangleMesh mesh = box(Vec3(0.2, 0.2, 0.2), {cells, cells, cells});
  source.add("cube", rigid ? rigid_model(mesh, 1000) : elastic_model(mesh, soft(1000), kTimeStep));
  Scene scene = contact_scene(kTimeStep, kGravity + Vec3(1, 0.5, 0));
  for (int i = 0; i < count; ++i) {
    scene.bodies.push_back(body("c" + std::to_string(i), "cube", Vec3(0, 0, 0.1 + 0.2 * i)));
    scene.bodies.back().friction = 0.5;
  }
  scene.obstacles = {plane(Vec3::Zero(), Vec3::UnitZ(), 0.5)};
  return made("stack of " + std::to_string(count) + (rigid ? " rigid cubes" : " cubes"), steps,
              scene, source);
}

/// Balls fall into a bowl in layers of four.
OwnScene heap(bool rigid, int layers, int steps) {
  MemorySource source;
  const TriangleMesh ball = icosphere(2, 0.06);
  source.add("ball", rigid ? rigid_model(ball, 1000)
                           : elastic_model(ball, material(1000, 3e4, 0.3), kTimeStep));
  source.add_obstacle("bowl", bowl(0.3, 0.02, 40));
  Scene scene = contact_scene(kTimeStep, kGravity);
  for (int i = 0; i < 4 * layers; ++i) {
    const double angle = 0.5 * kPi * i + 0.4 * (i / 4);
    scene.bodies.push_back(
        body("b" + std::to_string(i), "ball",
             Vec3(0.09 * std::cos(angle), 0.09 * std::sin(angle), -0.15 + 0.125 * (i / 4))));
    scene.bodies.back().friction = 0.5;
    scene.bodies.back().angular_velocity = Vec3(i % 3, i % 5, 2);
  }
  scene.obstacles = {mesh_obstacle("bowl", 0.5)};
  return made("heap of " + std::to_string(4 * layers) + (rigid ? " rigid balls" : " balls"), steps,
              scene, source);
}

}  // namespace

std::vector<NamedProblem> record_problems(OwnScene& scene, int count) {
  constexpr int kLeast = 10;  // contacts
  std::vector<NamedProblem> out;
  NamedProblem hardest;
  int most = 0, last = -scene.steps;
  scene.simulation->observe_contacts(
      [&](const FrictionProblem& p, const Eigen::VectorXd&, const FrictionResult& result) {
        if (p.contacts() < kLeast) return;
        const auto step = static_cast<int>(scene.simulation->steps());
        const std::string name = scene.name + ", step " + std::to_string(step + 1);
        if (result.newton_steps > most) {
          most = result.newton_steps;
          hardest = {name + "*", p};
        } else if (step >= last + scene.steps / count) {
          last = step;
          out.push_back({name, p});
        }
      });
  for (int n = 0; n < scene.steps; ++n) scene.simulation->step();
  scene.simulation->observe_contacts({});
  if (most > 0) out.push_back(std::move(hardest));
  return out;
}

int own_scene_count() {
  return 8;
}

OwnScene make_own_scene(int index) {
  switch (index) {
    case 0:
      return rolling_ball(60);
    case 1:
      return stack(true, 6, 2, 50);
    case 2:
      return stack(false, 6, 4, 40);
    case 3:
      return heap(true, 3, 120);
    case 4:
      return heap(false, 3, 72);
    case 5:
      return sliding_block(false, 8, true, 30);
    case 6:
      return sliding_block(false, 16, false, 30);
    case 7:
      return sliding_block(true, 30, false, 5);
  }
  throw Error(ErrorCode::internal, "no scene with this number");
}

}  // namespace bem
