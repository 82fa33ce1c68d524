#include "mesh/orientation.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using test::combined;

namespace {

std::vector<int> all_triangles(const TriangleMesh& mesh) {
  std::vector<int> triangles(mesh.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = static_cast<int>(t);
  return triangles;
}

std::vector<std::string> orient(TriangleMesh& mesh) {
  const TriangleMesh input = mesh;
  std::vector<std::string> warnings;
  orient_outward(input, mesh, "a.obj", warnings);
  return warnings;
}

const TriangleMesh kCube = box({1, 1, 1}, {2, 2, 2});

}  // namespace

TEST_CASE("the winding number tells inside from outside") {
  const std::vector<int> triangles = all_triangles(kCube);
  CHECK(winding_number(kCube, triangles, {0.1, 0.2, -0.3}) == Approx(1.0).epsilon(1e-12));
  CHECK(std::abs(winding_number(kCube, triangles, {0.1, 0.2, 0.8})) < 1e-12);
  CHECK(winding_number(kCube, triangles, {0.1, 0.2, 0.5 - 1e-9}) == Approx(1.0).epsilon(1e-6));
}

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

TEST_CASE("a body inside out is turned, with a warning") {
  TriangleMesh mesh = combined({}, kCube, 1.0, Vec3::Zero(), true);
  const auto warnings = orient(mesh);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("a.obj") && Contains("turned outward") &&
                              Contains("1 part of 1") && Contains("triangle 0 "));
  CHECK(mesh.triangles == kCube.triangles);
}

TEST_CASE("a cavity stays, and one with outward normals is turned into one and told so") {
  for (bool inward : {true, false}) {
    TriangleMesh mesh = combined(kCube, kCube, 0.5, Vec3::Zero(), inward);
    const auto warnings = orient(mesh);
    CHECK(warnings.size() == (inward ? 0 : 1));
    if (!inward)
      CHECK_THAT(warnings[0], Contains("inside of another one is its cavity") &&
                                  Contains("1 part of 2") && Contains("triangle 48 ") &&
                                  !Contains("pointed inward"));
    const auto components = surface_components(mesh);
    CHECK(components[0].volume == Approx(1));
    CHECK(components[1].volume == Approx(-0.125));
    CHECK(components[1].parent == 0);
  }
}

TEST_CASE("a body inside out is turned with its cavities") {
  TriangleMesh mesh = combined({}, kCube, 1.0, Vec3::Zero(), true);
  mesh = combined(mesh, kCube, 0.5, Vec3::Zero(), false);
  const auto warnings = orient(mesh);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("turned outward: 2 parts of 2"));
}

TEST_CASE("solids side by side keep their orientation") {
  TriangleMesh mesh = combined(kCube, kCube, 1.0, {1.5, 0, 0}, false);
  const TriangleMesh before = mesh;
  CHECK(orient(mesh).empty());
  CHECK(mesh.triangles == before.triangles);
}

TEST_CASE("parts that touch are told apart: on top is a solid, under the surface a cavity") {
  // Lower or upper vertices of the smaller cube lie in the larger one's top face.
  for (bool cavity : {false, true}) {
    const Vec3 place(0.07, 0.03, cavity ? 0.35 : 0.65);
    TriangleMesh mesh = combined(kCube, kCube, 0.3, place, cavity);
    const TriangleMesh before = mesh;
    CHECK(orient(mesh).empty());
    CHECK((mesh.triangles == before.triangles));
    CHECK(surface_components(mesh)[1].is_solid() == !cavity);
  }
}

TEST_CASE("a part that sticks out of another one is a solid of its own, however little") {
  for (double height : {0.35, 0.45, 0.5, 0.55}) {  // of a cube of 0.3 in one of 1
    TriangleMesh mesh = combined(kCube, kCube, 0.3, {0.07, 0.03, height}, false);
    CHECK(orient(mesh).size() == (height == 0.35 ? 1 : 0));
    CHECK(surface_components(mesh)[1].is_solid() == (height > 0.35));
  }
}
