#include "broken_meshes.hpp"
#include "repair/connected_parts.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("sets of triangles that share no vertex are parts") {
  const TriangleMesh mesh = both(soup_of(grid(2)), cube(), {10, 0, 0});
  const std::vector<TriangleMesh> parts = connected_parts(mesh);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].vertices.size() == 9);
  CHECK(parts[0].triangles.size() == 8);
  CHECK(parts[1].vertices.size() == 8);
  CHECK(parts[1].vertices[0] == cube().vertices[0] + Vec3(10, 0, 0));
}
