#include "mesh/mesh_io.hpp"
#include "mesh/obj_groups.hpp"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

const std::string kSquares =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 3 0 0\nv 3 1 0\n"
    "o My object\ng left both\nusemtl red\nf 1 2 3 4\ng right both right\nf 2 5 6 3\nusemtl blue\n"
    "g\nf 5 7 8 6\ng left\nf 1 2 3\n";

}  // namespace

TEST_CASE(
    "groups, objects and materials of an OBJ file hold until the next line of their keyword") {
  const NamedRanges groups = parse_obj_groups(kSquares, "a.obj");
  CHECK(groups == NamedRanges{{"My object", {{0, 4}}},
                              {"left", {{0, 1}, {3, 4}}},
                              {"both", {{0, 1}, {1, 2}}},
                              {"right", {{1, 2}}},
                              {"red", {{0, 2}}},
                              {"blue", {{2, 4}}}});
  CHECK(parse_obj_groups("g a\ng b\nusemtl c\n", "a.obj").empty());
}

TEST_CASE("groups of a mesh file count its triangles") {
  const std::string path = (std::filesystem::temp_directory_path() / "bem_groups.obj").string();
  std::ofstream(path) << kSquares;
  const NamedRanges groups = read_mesh_groups(path);
  CHECK(groups.at("left") == NamedRanges::mapped_type{{0, 2}, {6, 7}});
  CHECK(groups.at("blue") == NamedRanges::mapped_type{{4, 7}});
  CHECK(read_mesh(path).triangles.size() == 7);
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\ng a\nf 1 2 3\n";
  CHECK(read_mesh_groups(path) == NamedRanges{{"a", {{1, 2}}}});  // only triangles
  std::filesystem::remove(path);
}
