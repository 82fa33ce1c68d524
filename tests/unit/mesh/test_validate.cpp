#include "mesh/mesh_io.hpp"
#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "mesh/validate.hpp"
#include "mesh_test.hpp"

#include <limits>

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string refusal(const TriangleMesh& mesh) {
  return test::error_message(ErrorCode::invalid_input, [&] { make_surface(mesh, "a.obj"); });
}

}  // namespace

TEST_CASE("every kind of bad mesh is refused with its first element and the number of them") {
  struct Case {
    const char* file;
    const char* kind;
    const char* element;
    const char* total;
  };
  const Case cases[] = {
      {"open_boundary", "open boundary", "edge 2-1 of triangle 0 (vertices 0, 2, 1)",
       "3 such edges"},
      {"nonmanifold_edge", "non-manifold edge", "edge 1-0 of triangle 0 (vertices 0, 2, 1)",
       "4 triangles instead of 2 (counting from 0); 1 such edge in all"},
      {"nonmanifold_vertex", "non-manifold vertex", "vertex 0 at (0, 0, 0)", "1 such vertex"},
      {"inconsistent_orientation", "inconsistent orientation",
       "edge 0-2 of triangle 0 (vertices 0, 2, 1)", "3 such edges"},
      {"zero_area", "zero-area triangle",
       "triangle 1 (vertices 0, 4, 1) at (0, 0, 0), (0.5, 0, 0), (1, 0, 0)", "2 such triangles"},
      {"repeated_vertex", "zero-area triangle", "triangle 4 (vertices 1, 4, 2)",
       "2 such triangles"},
      {"nonfinite", "nonfinite.obj:3: non-finite coordinate", "vertex 1 at (nan, 0, 0)",
       "2 such vertices"},
      {"index_out_of_range", "index_out_of_range.obj:7: index out of range", "face 1 ",
       "2 such faces"},
      {"no_triangle", "no triangle at all", "", ""},
      {"zero_volume", "zero volume", "triangle 0 (vertices 0, 1, 2)", "1 such part"},
      {"unparsable_number", "unparsable_number.obj:4: ", "\"1.o\"", "not a number"},
      {"short_face", "short_face.obj:7: ", "at least three", ""}};
  for (const Case& c : cases) {
    const std::string path = std::string(BEM_TEST_DATA) + "/bad_meshes/" + c.file + ".obj";
    const auto load = [&] { make_surface(read_mesh(path), path); };
    const std::string message = test::error_message(ErrorCode::invalid_input, load);
    CHECK_THAT(message,
               StartsWith(path) && Contains(c.kind) && Contains(c.element) && Contains(c.total));
  }
}

TEST_CASE("meshes that do not come from a file are checked for indices and coordinates too") {
  TriangleMesh mesh = test::unit_tetrahedron();
  mesh.triangles[1][2] = 4;
  mesh.triangles[3][0] = -1;
  CHECK_THAT(refusal(mesh),
             StartsWith("a.obj: index out of range: triangle 1 (vertices 0, 1, 4)") &&
                 Contains("4 vertices") && Contains("2 such triangles"));
  mesh = test::unit_tetrahedron();
  mesh.vertices[2][1] = std::numeric_limits<double>::infinity();
  CHECK_THAT(refusal(mesh), StartsWith("a.obj: non-finite coordinate: vertex 2 at (0, inf, 0)") &&
                                Contains("1 such vertex"));
  mesh.triangles.clear();
  CHECK_THAT(refusal(mesh), Contains("no triangle at all"));
}

TEST_CASE("zero area is relative to the size of the triangle") {
  for (double scale : {1e-9, 1.0, 1e9}) {
    TriangleMesh mesh = test::unit_tetrahedron();
    for (Vec3& v : mesh.vertices) v *= scale;
    CHECK_NOTHROW(make_surface(mesh, "a.obj"));
    mesh.vertices[3] = scale * Vec3(0.5, 1e-9, 0);
    CHECK_THAT(refusal(mesh), Contains("zero-area triangle: triangle 1 ") && Contains("1e-08"));
  }
}

TEST_CASE("two cubes that share an edge or a face are refused") {
  const TriangleMesh cube = box({1, 1, 1}, {1, 1, 1});
  CHECK_THAT(refusal(test::combined(cube, cube, 1.0, {1, 1, 0}, false)),
             Contains("non-manifold edge") && Contains("1 such edge in"));
  CHECK_THAT(refusal(test::combined(cube, cube, 1.0, {1, 0, 0}, false)),
             Contains("non-manifold edge"));
}

TEST_CASE("a mesh where two sheets meet in one vertex is refused there") {
  TriangleMesh mesh = icosphere(1, 1.0);
  mesh.vertices[3] = mesh.vertices[0];  // opposite corners of the icosahedron
  CHECK_THAT(refusal(mesh), Contains("non-manifold vertex: vertex 0 at"));
}

TEST_CASE("thin triangles are counted, the first is named") {
  const TriangleMesh mesh = box({1, 1, 0.001}, {1, 1, 1});
  std::vector<std::string> warnings;
  warn_thin_triangles(mesh, mesh, "a.obj", warnings);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], StartsWith("a.obj: very thin triangles") && Contains("8 triangles"));
  warnings.clear();
  const TriangleMesh cube = box({1, 1, 0.02}, {1, 1, 1});
  warn_thin_triangles(cube, cube, "a.obj", warnings);
  CHECK(warnings.empty());
}
