#include "mesh/obj_reader.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string obj_error(const std::string& text) {
  return test::error_message(ErrorCode::invalid_input, [&] { parse_obj(text, "a.obj"); });
}

std::vector<std::vector<int>> faces_of(const PolygonMesh& mesh) {
  std::vector<std::vector<int>> faces;
  for (std::size_t f = 0; f < mesh.face_count(); ++f)
    faces.emplace_back(mesh.face(f), mesh.face(f) + mesh.corner_count(f));
  return faces;
}

using Faces = std::vector<std::vector<int>>;

const std::string kObjVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

}  // namespace

TEST_CASE("vertices and faces keep their order and all digits") {
  const PolygonMesh mesh = parse_obj(
      "v 0.1 -2e-3 +.5\nv 0.30000000000000004 0 1e300\nv 1 2 3\nf 3 1 2\nf 1 2 3\n", "a.obj");
  REQUIRE(mesh.vertices.size() == 3);
  CHECK(mesh.vertices[0] == Vec3(0.1, -2e-3, 0.5));
  CHECK(mesh.vertices[1] == Vec3(0.30000000000000004, 0, 1e300));
  CHECK(faces_of(mesh) == Faces{{2, 0, 1}, {0, 1, 2}});
  CHECK(mesh.lines == std::vector<int>{4, 5});
}

TEST_CASE("every way of writing a face corner is understood") {
  for (const std::string face :
       {"f 1 2 3", "f 1/4 2/5 3/6", "f 1//7 2//7 3//7", "f 1/4/7 2/5/7 3/6/7", "f -4 -3 -2",
        "f -4/-1 -3/-1 -2/-1", "f\t1  2 3 ", "f 1/ 2/ 3/", "f 1 2 3 # comment", "f 1 \\\n 2 3",
        "f 1 2 3\r"})
    CHECK(faces_of(parse_obj(kObjVertices + face + "\n", "a.obj")) == Faces{{0, 1, 2}});
}

TEST_CASE("faces keep all their corners, other keywords are ignored") {
  const PolygonMesh mesh =
      parse_obj("\xEF\xBB\xBFmtllib x\no thing\nvt 0 0\nvn 0 0 1\nusemtl m\n" + kObjVertices +
                    "v 1 1 0 0.5 0.5 0.5\ng a\ns 1\nl 1 2\nf 1 2 5 3 4",
                "a.obj");
  CHECK(mesh.vertices.size() == 5);
  CHECK(mesh.vertices[4] == Vec3(1, 1, 0));
  CHECK(faces_of(mesh) == Faces{{0, 1, 4, 2, 3}});
}

TEST_CASE("a face may refer to vertices further down") {
  CHECK(parse_obj("f 1 2 3\n" + kObjVertices, "a.obj").face_count() == 1);
}

TEST_CASE("lines may end with CR, LF or both") {
  std::string text = kObjVertices + "f 1 2 3\nf 1 \\\n 2 4\n# f 1 2 3\nf 2 3 4";
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    std::string lines;
    for (char c : text) lines += c == '\n' ? end : std::string(1, c);
    const PolygonMesh mesh = parse_obj(lines, "a.obj");
    CHECK(mesh.vertices.size() == 4);
    CHECK(faces_of(mesh) == Faces{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}});
    CHECK(mesh.lines == std::vector<int>{5, 6, 9});
  }
}

TEST_CASE("numbers that cannot be parsed are shown with their line") {
  CHECK_THAT(obj_error("\nv 0 zero 0"), StartsWith("a.obj:2:") && Contains("\"zero\""));
  CHECK_THAT(obj_error("v 0 1.5x 0"), StartsWith("a.obj:1:") && Contains("\"1.5x\""));
  CHECK_THAT(obj_error("v 0 +-1 0"), Contains("\"+-1\""));
  CHECK_THAT(obj_error("v 0 1e999 0"), Contains("\"1e999\"") && Contains("range"));
  CHECK_THAT(obj_error("v 0 0"), StartsWith("a.obj:1:") && Contains("three coordinates"));
  CHECK_THAT(obj_error(kObjVertices + "f 1 b 3"), StartsWith("a.obj:5:") && Contains("\"b\""));
  CHECK_THAT(obj_error(kObjVertices + "f 1 2.5 3"), Contains("\"2.5\""));
  CHECK_THAT(obj_error(kObjVertices + "f 1 2/1/1/1 3"), Contains("\"2/1/1/1\""));
  CHECK_THAT(obj_error(kObjVertices + "f 1 99999999999 3"), Contains("99999999999"));
  CHECK_THAT(obj_error(kObjVertices + "f 1 \\\n2 3\nf 1 2"),
             StartsWith("a.obj:7:") && Contains("at least three"));
}

TEST_CASE("non-finite coordinates are counted, the first is named") {
  const std::string message = obj_error("v 0 0 0\nv nan 0 0\nv 0 0 -inf\nf 1 2 3");
  CHECK_THAT(message, StartsWith("a.obj:2:") && Contains("non-finite") &&
                          Contains("vertex 1 at (nan, 0, 0)") && Contains("2 such vertices"));
}

TEST_CASE("indices out of range are counted, the first is named") {
  for (const std::string corner : {"5", "0", "-5", "-2147483648"}) {
    const std::string message =
        obj_error(kObjVertices + "f 1 2 3\nf 1 2 " + corner + "\nf 1 2 4\nf 2 3 " + corner);
    CHECK_THAT(message, StartsWith("a.obj:6:") && Contains("index out of range") &&
                            Contains("face 1 ") && Contains("2 such faces"));
  }
}
