#include "base/error.hpp"
#include "mesh/body_geometry.hpp"
#include "support/archives.hpp"

#include <functional>

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

namespace {

constexpr double kDensity = 1000;

/// What is said of the small body after a change; empty if nothing.
std::string fault_after(const std::function<void(BodyGeometry&)>& change) {
  BodyGeometry geometry = small_body();
  change(geometry);
  return error_of([&] { check_geometry(geometry, kDensity, "body"); }).second;
}

}  // namespace

TEST_CASE("a geometry as it was made is good") {
  CHECK(fault_after([](BodyGeometry&) {}).empty());
}

TEST_CASE("a geometry that is not that of its mesh is refused") {
  const std::vector<std::function<void(BodyGeometry&)>> changes = {
      [](BodyGeometry& g) { g.nodes.vertices[3][1] += 1e-3; },
      [](BodyGeometry& g) { g.input.vertices[5][0] = 1; },
      [](BodyGeometry& g) { std::swap(g.node_of_vertex[1], g.node_of_vertex[2]); },
      [](BodyGeometry& g) { g.node_of_vertex[4] = -1; },
      [](BodyGeometry& g) { g.nodes.vertices.push_back(g.nodes.vertices[0]); },
      [](BodyGeometry& g) { g.triangle_order[0] = g.triangle_order[1]; },
      [](BodyGeometry& g) { std::swap(g.triangle_order[0], g.triangle_order[1]); },
      [](BodyGeometry& g) { std::swap(g.nodes.triangles[0][0], g.nodes.triangles[0][1]); },
      [](BodyGeometry& g) {
        for (Triangle& t : g.nodes.triangles) std::swap(t[0], t[1]);  // inward
      },
      [](BodyGeometry& g) { g.nodes.triangles.pop_back(); },
      [](BodyGeometry& g) { g.input.triangles[0] = g.input.triangles[1]; },
      [](BodyGeometry& g) { g.mass.centre[0] += 0.01; },
      [](BodyGeometry& g) { g.mass.volume *= 1.01; },
      [](BodyGeometry& g) { g.mass.mass *= -1; },
      [](BodyGeometry& g) { g.mass.inertia(0, 1) += 0.1 * g.mass.inertia(0, 0); },
      [](BodyGeometry& g) { g.extent *= 2; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    CHECK(fault_after(changes[i]).find("body: ") == 0);
  }
}

TEST_CASE("triangles may start with any corner, and be turned outward") {
  CHECK(fault_after([](BodyGeometry& g) {
          Triangle& t = g.nodes.triangles[0];
          t = {t[1], t[2], t[0]};
        }).empty());
  CHECK(fault_after([](BodyGeometry& g) {
          for (Triangle& t : g.input.triangles) std::swap(t[0], t[1]);
        }).empty());
}
