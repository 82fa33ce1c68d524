#include "mesh/mesh_io.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

TEST_CASE("an OBJ file gives back the same doubles, vertices and faces") {
  TriangleMesh mesh = star(2, 0.3);
  mesh.vertices[0] = Vec3(1.0 / 3.0, -1e-17, 1.2345678901234567e30);
  const test::TemporaryFile file("round_trip.OBJ");
  write_obj(file.path(), mesh);
  const TriangleMesh read = read_mesh(file.path());
  CHECK(read.vertices == mesh.vertices);
  CHECK(read.triangles == mesh.triangles);
}

TEST_CASE("the OBJ text is the shortest that reads back") {
  const test::TemporaryFile file("short.obj");
  write_obj(file.path(), {{{0.1, 1, 0}, {-2.5e-9, 0, 0}, {0, 0, 0}}, {{2, 0, 1}}});
  CHECK(test::read_file(file.path()) == "v 0.1 1 0\nv -2.5e-09 0 0\nv 0 0 0\nf 3 1 2\n");
}

TEST_CASE("a mesh that is not there, or a directory, is invalid input") {
  for (const std::string path : {"/nonexistent/a.obj", "/nonexistent/a.stl"}) {
    const auto message = test::error_message(ErrorCode::invalid_input, [&] { read_mesh(path); });
    CHECK_THAT(message, StartsWith(path + ": ") && Contains("no such mesh file"));
  }
  const std::string directory = std::filesystem::temp_directory_path().string();
  CHECK_THAT(test::error_message(ErrorCode::invalid_input, [&] { read_mesh(directory); }),
             Contains("directory"));
}

TEST_CASE("a file that cannot be written is a resource error") {
  const auto write = [] { write_obj("/nonexistent/a.obj", test::unit_tetrahedron()); };
  CHECK_THAT(test::error_message(ErrorCode::resources, write), StartsWith("/nonexistent/a.obj: "));
}
