#include "rigid_bodies.hpp"

#include <random>

using namespace bem;
using namespace bem::test;

namespace {

Vec3 random_vector(std::mt19937_64& generator, double size) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double x = uniform(generator), y = uniform(generator), z = uniform(generator);
  return size * Vec3(x, y, z);
}

}  // namespace

TEST_CASE("tumbling cubes") {
  std::mt19937_64 generator(7);
  RigidBodies world;
  const TriangleMesh cube = box({0.1, 0.1, 0.1}, {1, 1, 1});
  for (int i = 0; i < 12; ++i)
    world.add(cube, 0.01 / 6, Vec3(0.12 * (i % 2), 0.12 * (i / 2 % 2), 0.15 + 0.18 * (i / 4)),
              random_vector(generator, 1), random_vector(generator, 15));
  const bool on_plane = GENERATE(true, false);
  if (on_plane) world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  else {
  TriangleMesh slab = box({0.5, 0.5, 0.05}, {5, 5, 1});
  for (Vec3& v : slab.vertices) v -= Vec3(0, 0, 0.025);
  world.add_obstacle(slab);}
  int most = 0;
  for (int step = 0; step < 400; ++step) {
    world.step();
    most = std::max(most, world.rounds);
    const double depth = world.penetration();
    const bool cut = world.cut_deeper_than(2e-6);
    if (depth > 1.01e-6 || cut || world.rounds > 12)
      WARN("step " << step << " depth " << depth << " cut " << cut << " rounds " << world.rounds
                   << " held " << world.held);
  }
  WARN("most rounds " << most);
}
