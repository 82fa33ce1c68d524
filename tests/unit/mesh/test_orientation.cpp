#include "mesh/orientation.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using test::combined;

namespace {

std::vector<std::string> orient(TriangleMesh& mesh) {
  const TriangleMesh input = mesh;
  std::vector<std::string> warnings;
  std::vector<Component> components = surface_components(mesh);
  orient_outward(input, mesh, components, "a.obj", warnings);
  const std::vector<Component> turned = surface_components(mesh);
  for (std::size_t c = 0; c < turned.size(); ++c) {  // what was known before holds afterwards
    CHECK(components[c].volume == Approx(turned[c].volume).epsilon(1e-13));
    CHECK(components[c].depth == turned[c].depth);
    CHECK(components[c].faces_outward());
  }
  return warnings;
}

const TriangleMesh kOutward = box({1, 1, 1}, {2, 2, 2});

}  // namespace

TEST_CASE("a body inside out is turned, with a warning") {
  TriangleMesh mesh = combined({}, kOutward, 1.0, Vec3::Zero(), true);
  const auto warnings = orient(mesh);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("a.obj") && Contains("turned outward") &&
                              Contains("1 part of 1") && Contains("triangle 0 "));
  CHECK(mesh.triangles == kOutward.triangles);
}

TEST_CASE("a cavity stays, and one with outward normals is turned into one and told so") {
  for (bool inward : {true, false}) {
    TriangleMesh mesh = combined(kOutward, kOutward, 0.5, Vec3::Zero(), inward);
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
  TriangleMesh mesh = combined({}, kOutward, 1.0, Vec3::Zero(), true);
  mesh = combined(mesh, kOutward, 0.5, Vec3::Zero(), false);
  const auto warnings = orient(mesh);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("turned outward: 2 parts of 2"));
}

TEST_CASE("solids side by side keep their orientation") {
  TriangleMesh mesh = combined(kOutward, kOutward, 1.0, {1.5, 0, 0}, false);
  const TriangleMesh before = mesh;
  CHECK(orient(mesh).empty());
  CHECK(mesh.triangles == before.triangles);
}

TEST_CASE("parts that touch are told apart: on top is a solid, under the surface a cavity") {
  // Lower or upper vertices of the smaller cube lie in the larger one's top face.
  for (bool cavity : {false, true}) {
    const Vec3 place(0.07, 0.03, cavity ? 0.35 : 0.65);
    TriangleMesh mesh = combined(kOutward, kOutward, 0.3, place, cavity);
    const TriangleMesh before = mesh;
    CHECK(orient(mesh).empty());
    CHECK((mesh.triangles == before.triangles));
    CHECK(surface_components(mesh)[1].is_solid() == !cavity);
  }
}

TEST_CASE("a part that sticks out of another one is a solid of its own, however little") {
  for (double height : {0.35, 0.45, 0.5, 0.55}) {  // of a cube of 0.3 in one of 1
    TriangleMesh mesh = combined(kOutward, kOutward, 0.3, {0.07, 0.03, height}, false);
    CHECK(orient(mesh).size() == (height == 0.35 ? 1 : 0));
    CHECK(surface_components(mesh)[1].is_solid() == (height > 0.35));
  }
}
