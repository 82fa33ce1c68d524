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
    const int column = i % 2, row = i / 2 % 2, layer = i / 4;
    const Vec3 velocity = random_vector(generator, speed);
    const Vec3 spin = random_vector(generator, 15 * speed);
    world.add(meshes[i % meshes.size()], 0.01 / 6, {0.15 * column, 0.15 * row, 0.18 + 0.18 * layer},
              velocity, spin);
  }
  return world;
}

void run(RigidBodies& world, int steps, bool star_shaped = true) {
  int most_rounds = 0;
  std::size_t held = 0;
  for (int step = 0; step < steps; ++step) {
    world.step();
    CAPTURE(step);
    const double depth = world.penetration();
    REQUIRE(depth <= world.options.tolerance);
    // Edges are not seen by the depth of vertices.
    if (star_shaped) REQUIRE_FALSE(world.cut_deeper_than(3 * world.options.tolerance));
    REQUIRE(world.rounds <= 10);
    most_rounds = std::max(most_rounds, world.rounds);
    held += world.held;
  }
  CHECK(most_rounds >= 3);  // something happened
  CHECK(held >= static_cast<std::size_t>(steps));
}

const TriangleMesh kTumbling = box({0.1, 0.1, 0.1}, {1, 1, 1});

}  // namespace

TEST_CASE("tumbling cubes end every step without penetration") {
  RigidBodies world = thrown({kTumbling}, 1, 7);
  world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  run(world, 300);
}

TEST_CASE("tumbling bodies of many shapes in a bowl end every step without penetration") {
  RigidBodies world = thrown({kTumbling, box({0.1, 0.1, 0.1}, {3, 3, 3}), icosphere(2, 0.05),
                              box({0.14, 0.05, 0.02}, {2, 1, 1})},
                             1, 3);
  TriangleMesh dish = bowl(0.4, 0.02, 40);
  dish.vertices = moved(dish.vertices, {0.075, 0.075, 0.38});
  world.add_obstacle(dish);
  run(world, 120);
}

TEST_CASE("quickly tumbling tetrahedra end every step without penetration") {
  const auto seed = GENERATE(range(1u, 21u));
  CAPTURE(seed);
  std::vector<TriangleMesh> meshes;
  for (unsigned i = 0; i < 12; ++i) {
    meshes.push_back(random_tetrahedron(100 * seed + i));
    std::vector<Vec3>& v = meshes.back().vertices;
    const Vec3 centre = (v[0] + v[1] + v[2] + v[3]) / 4;
    for (Vec3& p : v) p = 0.13 * (p - centre);
  }
  RigidBodies world = thrown(meshes, 2, seed);
  world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  run(world, 100);
}

TEST_CASE("tumbling rings end every step without penetration") {
  RigidBodies world = thrown({torus(0.04, 0.015, 16, 8)}, 1, 1);
  world.planes.push_back({Vec3::Zero(), Vec3::UnitZ()});
  run(world, 120, false);
}
