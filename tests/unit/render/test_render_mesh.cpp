#include "base/error.hpp"
#include "mesh/obj_reader.hpp"
#include "render/bound_mesh.hpp"
#include "render_test.hpp"
#include "support/temporary_folder.hpp"
#include "unit/mesh/mesh_test.hpp"

#include <fstream>

using namespace bem;

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A unit square with its middle, whose quads and triangle have UVs, seams and normals.
const std::string kSheet =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 5/1/1 6/2/1 7/3/1\nf 5/1/1 7/3/1 8/4/1\n";

}  // namespace

TEST_CASE("a render mesh has the faces and the UVs of its file") {
  const test::TemporaryFolder folder("render");
  write(folder / "sheet.obj", kSheet);
  const RenderMesh mesh = read_render_mesh(folder / "sheet.obj", 0.5);
  CHECK(mesh.triangles.vertices[6] == Vec3(1, 0.5, 0));
  CHECK(mesh.face_count() == 3);
  CHECK(mesh.starts == std::vector<std::size_t>{0, 4, 7, 10});
  CHECK(mesh.triangles.triangles ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
  CHECK(mesh.obj.corner_uvs() == std::vector<int>{0, 1, 2, 3, 0, 1, 2, 0, 2, 3});
  CHECK(mesh.obj.normals().size() == 8);
}

TEST_CASE("faces that cross themselves are shown, meshes without faces are not") {
  const test::TemporaryFolder folder("crossing");
  write(folder / "a.obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 3 2\n");
  CHECK(read_render_mesh(folder / "a.obj", 1).triangles.triangles.size() == 3);
  write(folder / "b.obj", "v 0 0 0\nv 1 1 0\nl 1 2\n");
  CHECK_THAT(
      test::error_message(ErrorCode::invalid_input, [&] { read_render_mesh(folder / "b.obj", 1); }),
      Catch::Matchers::Contains("b.obj") && Catch::Matchers::Contains("no faces"));
}

TEST_CASE("what cannot be bound is refused") {
  const test::TemporaryFolder folder("damaged");
  const auto refusal = [&](const std::string& x, const std::string& corner) {
    write(folder / "a.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0\n1 0 0\n1 " +
              x + " 0\n3 0 1 " + corner + "\n");
    return test::error_message(ErrorCode::invalid_input,
                               [&] { read_render_mesh(folder / "a.ply", 1); });
  };
  CHECK_THAT(refusal("nan", "2"), Catch::Matchers::Contains("a.ply"));
  CHECK_THAT(refusal("1", "3"), Catch::Matchers::Contains("a.ply"));
  write(folder / "a.obj", "v 0 0 0\nv 1e200 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK_THAT(
      test::error_message(ErrorCode::invalid_input, [&] { read_render_mesh(folder / "a.obj", 1); }),
      Catch::Matchers::Contains("too large"));
}

TEST_CASE("other formats become OBJ files with their UVs") {
  const test::TemporaryFolder folder("ply");
  write(folder / "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nproperty float s\nproperty float t\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 0.5 0\n"
        "1 1 0 0.5 0.5\n0 1 0 0 0.25\n4 0 1 2 3\n");
  const RenderMesh mesh = read_render_mesh(folder / "a.ply", 1);
  CHECK(mesh.starts == std::vector<std::size_t>{0, 4});
  CHECK(mesh.obj.text(mesh.triangles.vertices, {}, {}) ==
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 0.5\nvt 0 0.25\n"
        "f 1/1 2/2 3/3 4/4\n");
}

TEST_CASE("libraries are found from other folders") {
  const test::TemporaryFolder folder("libraries");
  std::filesystem::create_directories(folder / "in");
  std::filesystem::create_directories(folder / "out/obj");
  write(folder / "in/a b.mtl", "");
  write(folder / "in/c.mtl", "");
  write(folder / "in/a.obj", "mtllib a b.mtl\nmtllib c.mtl gone.mtl\n" + kSheet);
  const RenderMesh mesh = read_render_mesh(folder / "in/a.obj", 1);
  CHECK(mesh.libraries_from(folder / "out/obj") ==
        std::vector<std::string>{"../../in/a b.mtl", "../../in/c.mtl gone.mtl"});
  CHECK(mesh.libraries_from(folder / "in") ==
        std::vector<std::string>{"a b.mtl", "c.mtl gone.mtl"});
}

TEST_CASE("vertices at the same place stay together, normals turn with the surface") {
  const test::TemporaryFolder folder("seam");
  write(folder / "sheet.obj", kSheet);
  const auto mesh = std::make_shared<const RenderMesh>(read_render_mesh(folder / "sheet.obj", 1));
  TriangleMesh surface = box({2, 1, 0.1}, {8, 4, 1});
  for (Vec3& x : surface.vertices) x += Vec3(1, 0.5, -0.08);  // its upper side is 0.03 below
  const BoundMesh bound(mesh, surface);
  CHECK(bound.binding().farthest() == Approx(0.03));
  for (const auto& [name, motion] : test::strong_motions()) {
    INFO(name);
    const BoundMesh::Shape shape = bound.shape(test::moved(surface.vertices, motion));
    CHECK(shape.positions[1] == shape.positions[4]);
    CHECK(shape.positions[2] == shape.positions[7]);
  }
  const Mat3 turn = Eigen::AngleAxisd(2, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Vec3& n :
       bound.shape(test::moved(surface.vertices, [&](const Vec3& x) { return turn * x; })).normals)
    CHECK((n - turn.col(2)).norm() < 1e-15);
  Mat3 shear = Mat3::Identity();
  shear(2, 0) = 0.3;  // z += 0.3 x
  for (const Vec3& n :
       bound.shape(test::moved(surface.vertices, [&](const Vec3& x) { return shear * x; })).normals)
    CHECK((n - Vec3(-0.3, 0, 1).normalized()).norm() < 0.05);
}
