#include "mesh/off_reader.hpp"
#include "mesh_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::string off_error(const std::string& text) {
  return test::error_message(ErrorCode::invalid_input, [&] { parse_off(text, "a.off"); });
}

const std::string kOffVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string kOffFaces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

}  // namespace

TEST_CASE("every way of writing an OFF header is understood") {
  for (const std::string header :
       {"OFF\n4 4 6\n", "OFF 4 4 6\n", "OFF 4 4\n", "4 4 6\n",
        "# made by hand\n\nOFF # here\n\n4 4 0\n", "\xEF\xBB\xBFOFF\r\n4 4 6\r\n", "COFF\n4 4 6\n",
        "STCNOFF\n4 4 6\n"}) {
    const PolygonMesh mesh =
        parse_off(header + kOffVertices + "# faces\n" + kOffFaces + "\n# end", "a.off");
    CHECK(mesh.vertices == test::unit_tetrahedron().vertices);
    CHECK(mesh.face_count() == 4);
    CHECK(mesh.corners == std::vector<int>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  }
}

TEST_CASE("faces of an OFF file have any number of corners, and colours") {
  std::string text = "OFF\n12 3 0\n", face = "12";
  for (int k = 0; k < 12; ++k) {
    text += std::to_string(0.1 * k) + " 1e-3 0 255 0 0\n";
    face += " " + std::to_string(k);
  }
  const PolygonMesh mesh = parse_off(text + face + " 0.5 0.5 0.5\n2 0 1\n4 0 1 2 3 7\n", "a.off");
  REQUIRE(mesh.face_count() == 2);  // no line
  CHECK(mesh.corner_count(0) == 12);
  CHECK(mesh.corner_count(1) == 4);
  CHECK(mesh.lines == std::vector<int>{15, 17});
  CHECK(mesh.vertices[3] == Vec3(0.3, 1e-3, 0));
}

TEST_CASE("lines may end with CR alone") {
  std::string text = "OFF\n4 4 6\n" + kOffVertices + kOffFaces;
  std::replace(text.begin(), text.end(), '\n', '\r');
  CHECK(parse_off(text, "a.off").face_count() == 4);
}

TEST_CASE("what is wrong in an OFF file is named with its line") {
  const std::string head = "OFF\n4 4 6\n";
  CHECK_THAT(off_error(""), StartsWith("a.off:0:") && Contains("ends where"));
  CHECK_THAT(off_error("OFF\n"), Contains("ends where the number of vertices"));
  CHECK_THAT(off_error("hello\n"), StartsWith("a.off:1:") && Contains("\"hello\""));
  CHECK_THAT(off_error("OFF BINARY\n"), Contains("binary"));
  CHECK_THAT(off_error("4OFF\n4 4 6\n"), Contains("\"4\" of OFF file is not supported"));
  CHECK_THAT(off_error("OFF\n-1 4 6\n"), Contains("cannot be \"-1\""));
  CHECK_THAT(off_error("OFF\n2000000000 4 6\n"), Contains("cannot be \"2000000000\""));
  CHECK_THAT(off_error("OFF\n4\n"), Contains("the number of faces"));
  CHECK_THAT(off_error(head + "0 0\n"), StartsWith("a.off:3:") && Contains("three coordinates"));
  CHECK_THAT(off_error(head + "0 x 0\n"), Contains("\"x\" is not a number"));
  CHECK_THAT(off_error(head + "0 nan 0\n"), Contains("non-finite coordinate of vertex 0"));
  CHECK_THAT(off_error(head + "0 0 0 1 0\n"), Contains("this one has 5 numbers"));
  CHECK_THAT(off_error(head + kOffVertices), Contains("ends where face 0 of 4"));
  CHECK_THAT(off_error(head + kOffVertices + "3 0 1 4\n"),
             StartsWith("a.off:7:") && Contains("index out of range: face 0") &&
                 Contains("vertex 4, but the file has 4 vertices"));
  CHECK_THAT(off_error(head + kOffVertices + "3 0 -1 2\n"), Contains("vertex -1"));
  CHECK_THAT(off_error(head + kOffVertices + "4 0 1 2\n"), Contains("3 corners instead of 4"));
  CHECK_THAT(off_error(head + kOffVertices + "0\n"), Contains("cannot have 0 corners"));
  CHECK_THAT(off_error(head + kOffVertices + "-3 0 1 2\n"), Contains("cannot have"));
  CHECK_THAT(off_error(head + kOffVertices + kOffFaces + "3 0 1 2\n"),
             StartsWith("a.off:11:") && Contains("more lines than"));
}
