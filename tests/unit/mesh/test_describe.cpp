#include "mesh/describe.hpp"
#include "mesh_test.hpp"

using namespace bem;

TEST_CASE("points are written with their coordinates") {
  CHECK(to_text(Vec3(1, -0.5, 2e-9)) == "(1, -0.5, 2e-09)");
}

TEST_CASE("elements are named with the input's indices") {
  const TriangleMesh mesh = test::unit_tetrahedron();
  CHECK(triangle_text(mesh, 1) == "triangle 1 (vertices 0, 1, 3)");
  CHECK(vertex_text(mesh, 3) == "vertex 3 at (0, 0, 1)");
}
