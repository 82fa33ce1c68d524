#include "mesh/describe.hpp"
#include "mesh_test.hpp"

using namespace bem;

TEST_CASE("numbers read back exactly") {
  CHECK(to_text(0.1) == "0.1");
  CHECK(std::stod(to_text(1.0 / 3.0)) == 1.0 / 3.0);
  CHECK(to_text(Vec3(1, -0.5, 2e-9)) == "(1, -0.5, 2e-09)");
}

TEST_CASE("counts agree with their noun") {
  CHECK(count_text(1, "edge") == "1 edge");
  CHECK(count_text(3, "such edge") == "3 such edges");
  CHECK(count_text(1, "vertex") == "1 vertex");
  CHECK(count_text(2, "such vertex") == "2 such vertices");
}

TEST_CASE("elements are named with the input's indices") {
  const TriangleMesh mesh = test::unit_tetrahedron();
  CHECK(triangle_text(mesh, 1) == "triangle 1 (vertices 0, 1, 3)");
  CHECK(vertex_text(mesh, 3) == "vertex 3 at (0, 0, 1)");
}
