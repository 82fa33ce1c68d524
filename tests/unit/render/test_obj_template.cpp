#include "base/error.hpp"
#include "mesh/obj_reader.hpp"
#include "render/obj_template.hpp"

#include <random>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// What the template of a text makes of new vertices (k, 0.5, -1) and of normals (0, 0, 2k).
std::string again(const std::string& text, const std::vector<std::string>& libraries = {}) {
  const ObjTemplate obj(text);
  std::vector<Vec3> vertices, normals;
  for (std::size_t v = 0; v < parse_obj(text, "a.obj").vertices.size(); ++v)
    vertices.push_back(Vec3(double(v), 0.5, -1));
  for (std::size_t n = 0; n < obj.normals().size(); ++n)
    normals.push_back(Vec3(0, 0, 2 * double(n)));
  return obj.text(vertices, normals, libraries);
}

/// Some pieces of OBJ files in any order.
std::string random_text(std::mt19937& random) {
  static const std::vector<std::string> pieces{"v",
                                               "v 1 2 3\n",
                                               "v 4 5 6\r\n",
                                               "vn 0 0 1\n",
                                               "vt 1 2\n",
                                               "f",
                                               "f 1 2 3\n",
                                               "f -1 -2 -3\r",
                                               "f 1/1/1 2//1 3/1\n",
                                               " ",
                                               "\n",
                                               "\r",
                                               "\r\n",
                                               "\\",
                                               "\\\n",
                                               "\\\r\n",
                                               "\\\r",
                                               "#",
                                               "1",
                                               "2",
                                               "-1",
                                               "3/1/1",
                                               "2//2",
                                               "//",
                                               "surf 0 1 0 1 1//1 2/2/2\n",
                                               "mtllib a b\n",
                                               "\t"};
  std::string text = "v 1 2 3\nv 4 5 6\nv 0 0 1\nvn 0 0 1\nvn 0 1 0\nvt 0 0\nvt 1 1\n";
  for (auto left = random() % 14; left > 0; --left) {
    text += pieces[random() % pieces.size()];
    if (random() % 3 == 0) text += " ";
  }
  return text;
}

/// What both readers know of a text.
struct Contents {
  explicit Contents(const std::string& text) : mesh(parse_obj(text, "a.obj")), obj(text) {}
  bool operator==(const Contents& other) const {
    return mesh.vertices == other.mesh.vertices && mesh.corners == other.mesh.corners &&
           mesh.starts == other.mesh.starts && obj.uvs() == other.obj.uvs() &&
           obj.corner_uvs() == other.obj.corner_uvs() &&
           obj.normals().size() == other.obj.normals().size();
  }

  PolygonMesh mesh;
  ObjTemplate obj;
};

}  // namespace

TEST_CASE("all of an OBJ text but coordinates is kept as it is") {
  const std::string before =
                        "# made by hand\n\no thing\ng all of it\ns off\nusemtl red wine\nvt 0.25 "
                        ".75\nvt 1 1 0 # w\n",
                    after =
                        "vp 0.31 3.2\ncstype rat bspline\nf 1/1 2/2 3/1 4/2\nf -4 -3\t-2 # back\n"
                        "l 1 2 3\np 4\nunknown  words \\\n go on\nend";
  CHECK(again(before + "v 7 8 9\n  v 1e-3 +2 .5 0.5 # weight\nv\t-1 \\\n 2 \\\n3 1 0 0\nv 0 0 0\n" +
              after) ==
        before + "v 0 0.5 -1\n  v 1 0.5 -1 0.5 # weight\nv\t2 0.5 -1 1 0 0\nv 3 0.5 -1\n" + after);
}

TEST_CASE("all kinds of line ends are kept") {
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    INFO((end == "\n" ? "LF" : end == "\r" ? "CR" : "CR LF"));
    const auto text = [&](bool before) {
      std::string out;
      for (int k = 0; k < 3; ++k)
        out += (before ? "v 9 9 \\" + end + "9" : "v " + std::to_string(k) + " 0.5 -1") + end;
      out += before ? "vn 0 1 0" + end : "vn 0 0 0" + end + "vn 0 0 2" + end;
      out += "# f 9 9 9 \\" + end + "comment" + end + "f 1//1 2 \\" + end;
      return out + (before ? " 3//1" : " 3//2") + end;
    };
    CHECK(again(text(true)) == text(false));
    CHECK(ObjTemplate(text(true)).corner_uvs().size() == 3);
  }
  CHECK(again("\xEF\xBB\xBFv 9 9 9\nv 9 9 9\nv 9 9 9\nf 1 2 3") ==
        "\xEF\xBB\xBFv 0 0.5 -1\nv 1 0.5 -1\nv 2 0.5 -1\nf 1 2 3");
}

TEST_CASE("every vertex has the normals of its own corners") {
  const std::string text =
      "v 9 9 9\nv 9 9 9\nv 9 9 9\nv 9 9 9\nvn 0 0 1\n# between\nvn 0 3 0\nvn 7 0 0\ng a\n"
      "f 1//1 2//1 3//1\nf 1//2 3/5/2 4\nf -4/5/-2 -2/5/-2 -1/5/1\n";
  const ObjTemplate obj(text);
  REQUIRE(obj.normals().size() == 7);
  const std::vector<int> vertices{0, 0, -1, 1, 2, 2, 3};
  const std::vector<int> axes{2, 1, 0, 2, 2, 1, 2};
  for (std::size_t n = 0; n < 7; ++n) {
    CHECK(obj.normals()[n].point == vertices[n]);
    CHECK(obj.normals()[n].direction.normalized() == Vec3::Unit(axes[n]));
  }
  CHECK(again(text) ==
        "v 0 0.5 -1\nv 1 0.5 -1\nv 2 0.5 -1\nv 3 0.5 -1\nvn 0 0 0\nvn 0 0 2\nvn 0 0 4\nvn 0 0 6\n"
        "vn 0 0 8\nvn 0 0 10\nvn 0 0 12\n# between\ng a\n"
        "f 1//1 2//4 3//5\nf 1//2 3/5/6 4\nf -4/5/2 -2/5/6 -1/5/7\n");
}

TEST_CASE("numbers of normals stay where every vertex has its own") {
  const std::string text =
      "f 1//3 2//1 3//2\nv 0 0.5 -1\nvn 0 0 0\nvn 0 0 2\nvn 0 0 4\nv 1 0.5 -1\nv 2 0.5 -1\n";
  CHECK(again(text) == text);
}

TEST_CASE("corners lose normals that the file does not have") {
  const std::string vertices = "v 9 9 9\nv 9 9 9\nv 9 9 9\n",
                    found =
                        again(vertices + "f 1//1 2/7/3 3/7/0\nvn 0 0 1\nsurf 0 1 0 1 1//1 2//9\n");
  CHECK(found ==
        "v 0 0.5 -1\nv 1 0.5 -1\nv 2 0.5 -1\nf 1//1 2/7 3/7\nvn 0 0 0\nsurf 0 1 0 1 1//1 2\n");
}

TEST_CASE("texture coordinates are known by corner") {
  const ObjTemplate obj(
      "v 0 0 0\nv 0 0 0\nv 0 0 0\nvt 0.5 0.25\nf 1/1 2/-1 3\nf 1/2 2/3 3/0\nvt 1 0 7\n");
  CHECK(obj.uvs() == std::vector<std::array<double, 2>>{{0.5, 0.25}, {1, 0}});
  CHECK(obj.corner_uvs() == std::vector<int>{0, 0, -1, 1, -1, -1});
}

TEST_CASE("material libraries are replaced statement by statement") {
  const std::string text =
      "mtllib a b.mtl  c.mtl # two\nv 9 9 9\nv 9 9 9\nv 9 9 9\nmtllib d\nf 1 2 3\n";
  CHECK(ObjTemplate(text).libraries() == std::vector<std::string>{"a b.mtl  c.mtl", "d"});
  CHECK(again(text, {"../x", "y"}) ==
        "mtllib ../x # two\nv 0 0.5 -1\nv 1 0.5 -1\nv 2 0.5 -1\nmtllib y\nf 1 2 3\n");
}

TEST_CASE("coordinates read back to the same numbers") {
  const ObjTemplate obj("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n");
  const std::vector<Vec3> vertices{
      {0.1, 1.0 / 3, -1e-17}, {1e300, 0.30000000000000004, 0}, {-0.0, 1234567.125, 2}};
  const PolygonMesh read = parse_obj(obj.text(vertices, {}, {}), "a.obj");
  CHECK(read.vertices == vertices);
}

TEST_CASE("every text that can be read is written with the same contents") {
  std::mt19937 random(7);
  int accepted = 0;
  for (int k = 0; k < 2000; ++k) {
    const std::string text = random_text(random);
    try {
      parse_obj(text, "a.obj");
    } catch (const Error&) {
      continue;
    }
    ++accepted;
    const Contents before(text);
    std::vector<Vec3> normals;
    for (const PointNormal& n : before.obj.normals()) normals.push_back(n.direction);
    INFO(text);
    CHECK(before.obj.corner_uvs().size() == before.mesh.corners.size());
    CHECK(Contents(before.obj.text(before.mesh.vertices, normals, before.obj.libraries())) ==
          before);
  }
  CHECK(accepted > 500);
}
