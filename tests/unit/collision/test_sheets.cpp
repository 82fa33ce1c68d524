#include "mesh/two_sided.hpp"
#include "mesh/weld.hpp"
#include "rigid_bodies.hpp"

using namespace bem;
using namespace bem::test;

namespace {

constexpr double kOffset = 1e-5;  ///< of the two layers of a sheet

const TriangleMesh kBall = icosphere(2, 0.05);

TriangleMesh layers_of(const TriangleMesh& sheet) {
  TwoSided sides = make_two_sided(weld(sheet).mesh);
  for (std::size_t v = 0; v < sides.offsets.size(); ++v)
    sides.layers.vertices[v] += kOffset * sides.offsets[v];
  sides.layers.triangles.insert(sides.layers.triangles.end(), sides.rim.begin(), sides.rim.end());
  return sides.layers;
}

TriangleMesh flat(int cells, bool downward) {
  TriangleMesh mesh;
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j)
      mesh.vertices.emplace_back(-0.5 + 1.0 * i / cells, -0.5 + 1.0 * j / cells, 0);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int a = i * (cells + 1) + j, b = a + cells + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  if (downward)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Lets a ball fall onto the sheet; the lowest place of its centre.
double lowest(const TriangleMesh& sheet, const Vec3& start, const Vec3& velocity, int steps) {
  RigidBodies world;
  world.options.recovery_depth = 2 * kOffset;
  world.add(kBall, 0.001, start, velocity, Vec3::Zero());
  world.add_obstacle(layers_of(sheet));
  double low = start[2];
  for (int i = 0; i < steps; ++i) {
    world.step();
    low = std::min(low, world.bodies()[0].position[2]);
  }
  return low;
}

}  // namespace

TEST_CASE("a sheet holds whichever way its triangles face") {
  for (bool downward : {false, true})
    for (int cells : {1, 7}) {
      CAPTURE(downward, cells);
      const double low = lowest(flat(cells, downward), {0.03, 0.02, 0.1}, {0.2, 0.1, -1}, 200);
      CHECK(low > 0.045);
      CHECK(low < 0.0501);
    }
}

TEST_CASE("a vertex stays on the side of a sheet on which it is") {
  // the ball starts with its lowest vertex in the sheet, and rests on it
  double bottom = 0;
  for (const Vec3& v : kBall.vertices) bottom = std::min(bottom, v[2]);
  CHECK(lowest(flat(3, true), {0.03, 0.02, -bottom}, Vec3::Zero(), 100) > -bottom - kOffset);
}

TEST_CASE("a sheet holds a body that is thrown against its rim") {
  TriangleMesh wall = flat(4, false);  // upright, with its rim on top
  for (Vec3& v : wall.vertices) v = Vec3(v[0], 0, v[1] - 0.5);
  const double low = lowest(wall, {0.03, 0, 0.2}, {0, 0, -1}, 80);
  CHECK(low > 0.04);
}

TEST_CASE("sheets that meet in one edge hold in each wedge") {
  TriangleMesh cross = flat(4, false);
  TriangleMesh fin = flat(4, false);
  const int n = static_cast<int>(cross.vertices.size());
  // the fin stands on the middle line of the sheet, x = 0
  for (const Vec3& v : fin.vertices) cross.vertices.emplace_back(0, v[1], v[0] + 0.5);
  for (const auto& [a, b, c] : fin.triangles) cross.triangles.push_back({a + n, b + n, c + n});
  RigidBodies world;
  world.options.recovery_depth = 2 * kOffset;
  world.add(kBall, 0.001, {0.2, 0, 0.1}, {-2, 0, -1}, Vec3::Zero());
  world.add(kBall, 0.001, {-0.2, 0.02, 0.1}, {2, 0, -1}, Vec3::Zero());
  world.add_obstacle(layers_of(cross));
  for (int i = 0; i < 100; ++i) {
    world.step();
    REQUIRE(world.bodies()[0].position[0] > 0.045);
    REQUIRE(world.bodies()[1].position[0] < -0.045);
    REQUIRE(world.bodies()[0].position[2] > 0.045);
  }
}
