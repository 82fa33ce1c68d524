#include "mesh/body_geometry.hpp"
#include "support/models.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

TEST_CASE("geometry keeps the input and orders nodes around the centre of mass") {
  TriangleMesh mesh = box(Vec3(1, 0.5, 0.25), {4, 3, 2});
  for (Vec3& v : mesh.vertices) v += Vec3(3, -1, 2);
  mesh.vertices.push_back(Vec3(9, 9, 9));  // used by no triangle
  const BodyGeometry g = geometry_of(mesh, 2000);
  CHECK(g.mass.mass == Approx(250));
  CHECK((g.mass.centre - Vec3(3, -1, 2)).norm() < 1e-12);
  CHECK(mass_properties(g.nodes, 1).centre.norm() < 1e-12);
  CHECK(g.extent == Approx(Vec3(1, 0.5, 0.25).norm()));
  REQUIRE(g.node_of_vertex.size() == mesh.vertices.size());
  CHECK(g.node_of_vertex.back() == -1);
  for (std::size_t v = 0; v + 1 < mesh.vertices.size(); ++v)
    CHECK((g.nodes.vertices[g.node_of_vertex[v]] + g.mass.centre - mesh.vertices[v]).norm() <
          1e-14);
  for (std::size_t t = 0; t < g.nodes.triangles.size(); ++t)
    for (int a = 0; a < 3; ++a)
      CHECK(g.nodes.triangles[t][a] == g.node_of_vertex[mesh.triangles[g.triangle_order[t]][a]]);
}
