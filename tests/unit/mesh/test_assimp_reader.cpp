#include "mesh/assimp_reader.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/surface.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Corners 0, e1, e2, e3 in reverse order, so that an order by use would show.
const std::vector<Vec3> kReversed{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}};
const std::vector<Triangle> kReversedFaces{{2, 1, 0}, {3, 0, 1}, {3, 2, 0}, {3, 1, 2}};

const char* const kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
const char* const kCoordinates = "0 0 1\n0 1 0\n1 0 0\n0 0 0\n";
const char* const kFaces = "3 2 1 0\n3 3 0 1\n3 3 2 0\n3 3 1 2\n";

std::string stl_text() {
  const TriangleMesh mesh = test::unit_tetrahedron();
  std::string text = "solid t\n";
  for (const Triangle& t : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int v : t) {
      text += "vertex";
      for (int k = 0; k < 3; ++k) text += mesh.vertices[v][k] > 0.5 ? " 1e-6" : " 0";
      text += "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid t\n";
}

}  // namespace

TEST_CASE("PLY and OFF keep their vertex order") {
  const test::TemporaryFile ply("a.ply", std::string(kPlyHeader) + kCoordinates + kFaces);
  const test::TemporaryFile off("a.off", std::string("OFF\n4 4 6\n") + kCoordinates + kFaces);
  for (const test::TemporaryFile* file : {&ply, &off}) {
    const TriangleMesh mesh = read_mesh(file->path());
    CHECK(mesh.vertices == kReversed);
    CHECK(mesh.triangles == kReversedFaces);
    CHECK(make_surface(mesh, "a").warnings.empty());
  }
}

TEST_CASE("an STL file is joined, however small the body is") {
  const test::TemporaryFile stl("small.stl", stl_text());
  const TriangleMesh mesh = read_mesh(stl.path());
  CHECK(mesh.vertices.size() == 4);
  REQUIRE(mesh.triangles.size() == 4);
  CHECK(mesh.vertices[1][1] == Approx(1e-6));
  CHECK(make_surface(mesh, "small.stl").warnings.empty());
}

TEST_CASE("node transforms are applied and mirrored parts stay outward") {
  const test::TemporaryFile bin("part.bin", [] {
    const TriangleMesh mesh = test::unit_tetrahedron();
    std::string bytes;
    for (const Vec3& v : mesh.vertices)
      for (int k = 0; k < 3; ++k) {
        const float x = static_cast<float>(v[k]);
        bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
      }
    for (const Triangle& t : mesh.triangles)
      for (int v : t) bytes += {static_cast<char>(v), '\0'};
    return bytes;
  }());
  const std::string name = std::filesystem::path(bin.path()).filename().string();
  const test::TemporaryFile gltf("part.gltf",
                                 R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"translation":[10,0,0],"children":[1]},{"mesh":0,"scale":[-2,2,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"buffers":[{"byteLength":72,"uri":")" +
                                     name + R"("}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":48},
{"buffer":0,"byteOffset":48,"byteLength":24}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]},
{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})");
  const TriangleMesh mesh = read_mesh(gltf.path());
  REQUIRE(mesh.vertices.size() == 4);
  const BoundingBox box = bounding_box(mesh.vertices);
  CHECK(box.min.isApprox(Vec3(8, 0, 0)));
  CHECK(box.max.isApprox(Vec3(10, 2, 2)));
  CHECK(make_surface(mesh, "part.gltf").warnings.empty());  // no "turned outward"
}

TEST_CASE("damaged files are invalid input, named with their cause") {
  const std::string ply = std::string(kPlyHeader) + kCoordinates + kFaces;
  const std::pair<std::string, std::string> files[] = {
      {"empty.stl", ""},
      {"truncated.stl", stl_text().substr(0, 150)},
      {"cut_in_faces.ply", ply.substr(0, ply.size() - 6)},
      {"cut_in_vertices.ply", ply.substr(0, std::string(kPlyHeader).size() + 9)},
      {"index.ply",
       std::string(kPlyHeader) + kCoordinates + "3 2 1 0\n3 3 0 1\n3 3 2 0\n3 3 1 9\n"},
      {"unknown.xyz", "hello\n"},
      {"garbage.glb", "glTF\x02\x01\x7f\x03garbage"},
      {"garbage.3ds", std::string(100, 'M')},
      {"garbage.dae", "<COLLADA><geometry>"}};
  for (const auto& [name, content] : files) {
    const test::TemporaryFile file(name, content);
    const auto read = [&] { make_surface(read_mesh(file.path()), file.path()); };
    const std::string message = test::error_message(ErrorCode::invalid_input, read);
    CHECK_THAT(message, StartsWith(file.path() + ": "));
    CHECK(message.size() > file.path().size() + 15);
  }
}
