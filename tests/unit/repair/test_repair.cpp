#include "../mesh/mesh_test.hpp"
#include "broken_meshes.hpp"
#include "mesh/mass_properties.hpp"
#include "repair/acceptance.hpp"
#include "repair/repair.hpp"

#include <limits>

using namespace bem;
using namespace bem::test;

namespace {

bool is_accepted(const TriangleMesh& mesh) {
  return check_acceptance(mesh).accepted();
}

std::string all_steps(const RepairedMesh& repaired) {
  std::string text;
  for (const std::string& step : repaired.report.steps) text += step + "\n";
  return text;
}

}  // namespace

TEST_CASE("a mesh that is fine stays as it is") {
  TriangleMesh hollow = combined(icosphere(1, 1), icosphere(1, 1), 0.5, Vec3::Zero(), true);
  for (Vec3& v : hollow.vertices) v += Vec3(0.1, 0.2, 0.3);
  hollow.vertices.emplace_back(7, 7, 7);  // unused
  const RepairedMesh same = repair_mesh(hollow, {}, "hollow");
  CHECK(same.mesh.vertices == hollow.vertices);
  CHECK(same.mesh.triangles == hollow.triangles);
  CHECK(!same.report.changed);
  CHECK(same.report.steps.empty());
}

TEST_CASE("meshes of any size are mended alike") {
  for (const double size : {1e-8, 1.0, 1e6}) {
    TriangleMesh mesh = shuffled(without(icosphere(2, size), 5, 2));
    for (Vec3& v : mesh.vertices) v += Vec3(3, 2, 1) * size;
    const RepairedMesh mended = repair_mesh(mesh, {}, "ball");
    REQUIRE(is_accepted(mended.mesh));
    CHECK(mass_properties(mended.mesh, 1).volume / std::pow(size, 3) ==
          Approx(4.047).epsilon(1e-2));
    CHECK(all_steps(mended).find("filled") != std::string::npos);
    CHECK(all_steps(mended).find("over") != std::string::npos);
    CHECK(!mended.report.wrapped);
  }
}

TEST_CASE("sheets get a thickness, and the report says which") {
  RepairOptions options;
  options.thickness = 0.05;
  const RepairedMesh plate = repair_mesh(grid(4), options, "sheet");
  REQUIRE(is_accepted(plate.mesh));
  CHECK(plate.report.sheet);
  CHECK(mass_properties(plate.mesh, 1).volume == Approx(16 * 0.05 * std::sqrt(32.0)));
  CHECK(all_steps(plate).find("0.283 m (5 % of its size") != std::string::npos);
}

TEST_CASE("parts that cross or lie apart are wrapped to one solid") {
  RepairOptions options;
  options.alpha = 0.1;
  options.offset = 0.01;
  for (const double apart : {0.7, 4.0}) {
    const TriangleMesh two = both(icosphere(2, 0.5), icosphere(2, 0.4), {apart, 0.1, 0.2});
    const RepairedMesh one = repair_mesh(two, options, "two");
    CHECK(is_accepted(one.mesh));
    CHECK(one.report.wrapped);
    CHECK((all_steps(one).find("with bars") != std::string::npos) == (apart > 1));
  }
}

TEST_CASE("a regular mesh has neighbours of every number of nodes") {
  for (const int nodes : {104, 414, 500}) {
    RepairOptions options;
    options.nodes = nodes;
    const RepairedMesh remeshed = repair_mesh(icosphere(3, 1), options, "ball");
    CHECK(!remeshed.report.wrapped);
    CHECK(std::abs(remeshed.mesh.vertices.size() / double(nodes) - 1) <= 0.1);
  }
}

TEST_CASE("a mesh is remeshed to a number of nodes") {
  for (const int nodes : {60, 400}) {
    RepairOptions options;
    options.mode = RepairMode::off;
    options.nodes = nodes;
    const RepairedMesh remeshed = repair_mesh(box({3, 1, 1}, {6, 2, 2}), options, "box");
    REQUIRE(is_accepted(remeshed.mesh));
    CHECK(std::abs(remeshed.mesh.vertices.size() / double(nodes) - 1) <= 0.1);
    CHECK(mass_properties(remeshed.mesh, 1).volume == Approx(3).epsilon(1e-9));  // edges are kept
  }
}

TEST_CASE("the edges of a cube are kept at any number of nodes") {
  for (const int nodes : {20, 30, 40, 50, 60, 100}) {
    RepairOptions options;
    options.nodes = nodes;
    const RepairedMesh found = repair_mesh(box({1, 1, 1}, {1, 1, 1}), options, "cube");
    INFO(nodes << " nodes: " << found.report.steps.back());
    CHECK(mass_properties(found.mesh, 1).volume == Approx(1));
    CHECK(found.mesh.vertices.size() > 0.5 * nodes);
    CHECK(found.mesh.vertices.size() < 1.5 * nodes);
  }
}

TEST_CASE("lost volume is told, and a coarse ball is not wrapped") {
  RepairOptions options;
  options.nodes = 60;
  const RepairedMesh ball = repair_mesh(icosphere(1, 1), options, "ball");
  CHECK(!ball.report.wrapped);
  options.nodes = 30;
  const RepairedMesh coarse = repair_mesh(icosphere(3, 1), options, "ball");
  CHECK(coarse.report.other_volume);
  CHECK_THAT(coarse.report.steps.back(), Catch::Contains("% less volume"));
}

TEST_CASE("edges of tiny features are not kept where they leave next to nothing of triangles") {
  TriangleMesh pimple{{{0, 0, -1}, {0, 0, 4.5e-4}}, {}};  // on a disc above a cone
  const int n = 12;
  for (const double radius : {1.0, 4e-4})
    for (int i = 0; i < n; ++i)
      pimple.vertices.emplace_back(radius * std::cos(i * kPi / 6), radius * std::sin(i * kPi / 6),
                                   0);
  for (int i = 0; i < n; ++i) {
    const int a = 2 + i, b = 2 + (i + 1) % n;
    for (const Triangle& t : {Triangle{0, b, a}, Triangle{a, b, b + n}, Triangle{a, b + n, a + n},
                              Triangle{a + n, b + n, 1}})
      pimple.triangles.push_back(t);
  }
  RepairOptions options;
  options.nodes = 100;
  const RepairedMesh remeshed = repair_mesh(pimple, options, "pimple");
  REQUIRE(is_accepted(remeshed.mesh));
  for (const Triangle& t : remeshed.mesh.triangles) CHECK(height_ratio(remeshed.mesh, t) > 0.1);
  CHECK(mass_properties(remeshed.mesh, 1).volume == Approx(1).epsilon(0.1));
}

TEST_CASE("what cannot be repaired is refused in a sentence") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  const TriangleMesh bad{{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}};
  const auto message = [](const TriangleMesh& mesh) {
    return error_message(ErrorCode::invalid_input, [&] { repair_mesh(mesh, {}, "m.obj"); });
  };
  CHECK(message(line) == "m.obj: the mesh cannot be repaired: no triangle has an area");
  CHECK(message(bad).find("non-finite") != std::string::npos);
  RepairOptions off;
  off.mode = RepairMode::off;
  off.nodes = 100;
  error_message(ErrorCode::invalid_input, [&] { repair_mesh(grid(2), off, "m.obj"); });
  off.nodes = 3;
  error_message(ErrorCode::usage, [&] { repair_mesh(cube(), off, "m.obj"); });
}
