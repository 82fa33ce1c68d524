#include "mesh/components.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;
using test::combined;

namespace {

const TriangleMesh kCube = box({1, 1, 1}, {2, 2, 2});

}  // namespace

TEST_CASE("components know their size and depth") {
  TriangleMesh mesh = combined(kCube, kCube, 0.5, Vec3::Zero(), true);
  mesh = combined(mesh, kCube, 0.25, Vec3::Zero(), false);
  mesh = combined(mesh, kCube, 1.0, {3, 0, 0}, false);
  const std::vector<Component> components = surface_components(mesh);
  REQUIRE(components.size() == 4);
  const double volumes[] = {1, -0.125, 1.0 / 64, 1};
  const int depths[] = {0, 1, 2, 0};
  for (int c = 0; c < 4; ++c) {
    CHECK(components[c].volume == Approx(volumes[c]).epsilon(1e-13));
    CHECK(components[c].depth == depths[c]);
    CHECK(components[c].triangles.size() == 48);
    CHECK(components[c].triangles.front() == 48 * c);
  }
  CHECK(components[3].area == Approx(6.0).epsilon(1e-13));
}

TEST_CASE("a component that is turned over has the negative volume") {
  TriangleMesh mesh = combined(kCube, kCube, 0.5, {2, 0, 0}, false);
  std::vector<Component> components = surface_components(mesh);
  turn_over(mesh, components[1]);
  CHECK(components[1].volume == Approx(-0.125).epsilon(1e-13));
  CHECK_FALSE(components[1].faces_outward());
  CHECK(surface_components(mesh)[1].volume == Approx(-0.125).epsilon(1e-13));
  CHECK(surface_components(mesh)[0].volume == Approx(1).epsilon(1e-13));
}
