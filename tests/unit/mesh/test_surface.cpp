#include "mesh/mass_properties.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;

TEST_CASE("a good mesh passes unchanged and without a warning") {
  const TriangleMesh mesh = star(2, 1.0);
  const Surface surface = make_surface(mesh, "a.obj");
  CHECK(surface.warnings.empty());
  CHECK(surface.input.vertices == mesh.vertices);
  CHECK(surface.input.triangles == mesh.triangles);
  CHECK(surface.nodes.vertices == mesh.vertices);
  CHECK(surface.nodes.triangles == mesh.triangles);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    REQUIRE(surface.node_of_vertex[v] == static_cast<int>(v));
}

TEST_CASE("a triangle soup is welded, the input stays as it is") {
  const TriangleMesh solid = icosphere(1, 1.0);
  TriangleMesh soup;
  for (const Triangle& t : solid.triangles) {
    const int n = static_cast<int>(soup.vertices.size());
    for (int v : t) soup.vertices.push_back(solid.vertices[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  const Surface surface = make_surface(soup, "a.stl");
  CHECK(surface.warnings.empty());
  CHECK(surface.nodes.vertices.size() == solid.vertices.size());
  CHECK(surface.input.vertices.size() == 3 * solid.triangles.size());
  for (std::size_t v = 0; v < soup.vertices.size(); ++v)
    REQUIRE(surface.nodes.vertices[surface.node_of_vertex[v]] == soup.vertices[v]);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      REQUIRE(surface.nodes.triangles[t][k] == surface.node_of_vertex[soup.triangles[t][k]]);
}

TEST_CASE("an inward mesh is turned outward in the nodes only") {
  const TriangleMesh mesh = test::combined({}, icosphere(1, 1.0), 1.0, {1, 2, 3}, true);
  const Surface surface = make_surface(mesh, "a.obj");
  REQUIRE(surface.warnings.size() == 1);
  CHECK_THAT(surface.warnings[0], Contains("a.obj") && Contains("inward"));
  CHECK(surface.input.triangles == mesh.triangles);
  CHECK(mass_properties(surface.nodes, 1.0).volume == Approx(-mass_properties(mesh, 1.0).volume));
  CHECK(mass_properties(surface.nodes, 1.0).volume > 3);
}

TEST_CASE("vertices without a triangle are kept, marked and warned about") {
  TriangleMesh mesh = test::unit_tetrahedron();
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v += 1;
  mesh.vertices.insert(mesh.vertices.begin(), Vec3(7, 8, 9));
  mesh.vertices.emplace_back(5, 5, 5);
  const Surface surface = make_surface(mesh, "a.obj");
  CHECK(surface.node_of_vertex == std::vector<int>{-1, 0, 1, 2, 3, -1});
  CHECK(surface.nodes.vertices.size() == 4);
  CHECK(surface.nodes.triangles == test::unit_tetrahedron().triangles);
  REQUIRE(surface.warnings.size() == 1);
  CHECK_THAT(surface.warnings[0], Contains("2 vertices") && Contains("vertex 0 at (7, 8, 9)"));
}

TEST_CASE("a self-intersection is a warning with the first pair and the count") {
  const TriangleMesh cube = box({1, 1, 1}, {1, 1, 1});
  const Surface surface =
      make_surface(test::combined(cube, cube, 1.0, Vec3(0.6, 0.55, 0.45), false), "a.obj");
  REQUIRE(surface.warnings.size() == 1);
  CHECK_THAT(surface.warnings[0],
             Contains("intersects itself") && Contains("pairs of triangles, first triangle "));
}
