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

/// Bodies thrown at each other above a floor, a slab or into a bowl.
RigidBodies thrown(const std::vector<TriangleMesh>& meshes, double speed, unsigned seed) {
  std::mt19937_64 generator(seed);
  RigidBodies world;
  for (int i = 0; i < 12; ++i) {
    const Vec3 velocity = random_vector(generator, speed);
    const Vec3 spin = random_vector(generator, 15 * speed);
    world.add(meshes[i % meshes.size()], 0.01 / 6,
              {0.15 * (i % 2), 0.15 * (i / 2 % 2), 0.18 + 0.18 * (i / 4)}, velocity, spin);
  }
  return world;
}

void run(RigidBodies& world, int steps, bool star_shaped = true) {
  double deepest = 0;
  int most_rounds = 0;
  for (int step = 0; step < steps; ++step) {
    world.step();
    CAPTURE(step);
    const double depth = world.penetration();
    REQUIRE(depth <= world.options.tolerance);
    // Edges are not seen by the depth of vertices.
    if (star_shaped) REQUIRE_FALSE(world.cut_deeper_than(3 * world.options.tolerance));
    REQUIRE(world.rounds <= 10);
    deepest = std::max(deepest, depth);
    most_rounds = std::max(most_rounds, world.rounds);
  }
  CHECK(most_rounds >= 3);  // something happened
  CHECK(world.held >= 5);
  INFO("deepest " << deepest << " m, at most " << most_rounds << " rounds");
}

const TriangleMesh kCube = box({0.1, 0.1, 0.1}, {1, 1, 1});

}  // namespace

TEST_CASE("tumbling cubes end every step without penetration") {
  RigidBodies world = thrown({kCube}, 1, 7);
  world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  run(world, 300);
}

TEST_CASE("tumbling bodies of many shapes in a bowl end every step without penetration") {
  RigidBodies world = thrown({kCube, box({0.1, 0.1, 0.1}, {3, 3, 3}), icosphere(2, 0.05),
                              box({0.14, 0.05, 0.02}, {2, 1, 1})},
                             1, 3);
  TriangleMesh dish = bowl(0.4, 0.02, 40);
  dish.vertices = moved(dish.vertices, {0.075, 0.075, 0.38});
  world.add_obstacle(dish);
  run(world, 120);
}

TEST_CASE("tumbling rings end every step without penetration") {
  RigidBodies world = thrown({torus(0.04, 0.015, 16, 8)}, 1, 1);
  world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  run(world, 120, false);
}
