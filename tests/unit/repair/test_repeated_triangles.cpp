#include "broken_meshes.hpp"
#include "repair/repeated_triangles.hpp"
#include "repair/soup.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("of repeated triangles one stays, of a wall between solids none") {
  TriangleMesh repeated = cube();
  repeated.triangles.push_back(repeated.triangles[3]);
  CHECK(drop_repeated(repeated) == 1);
  CHECK(count_bad_edges(repeated).total() == 0);

  TriangleMesh two = both(cube(), cube(), {1, 0, 0});
  weld_within(two, 0);
  const std::size_t before = two.triangles.size();
  CHECK(drop_repeated(two) > 0);
  CHECK(two.triangles.size() < before);
  CHECK(count_bad_edges(two).total() == 0);

  TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
  CHECK(drop_repeated(sheet) == 1);
}

TEST_CASE("a quadrangle with both diagonals loses one") {
  TriangleMesh mesh{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                    {{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
  CHECK(drop_other_diagonals(mesh) == 2);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  TriangleMesh tetrahedron = random_tetrahedron(1);
  CHECK(drop_other_diagonals(tetrahedron) == 0);
}
