#include "mesh/weld.hpp"
#include "mesh_test.hpp"

using namespace bem;

TEST_CASE("equal positions become one node, in the order of the vertices") {
  const TriangleMesh mesh{{{5, 5, 5}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}},
                          {{5, 3, 4}, {2, 1, 4}}};
  const Welded welded = weld(mesh);
  CHECK(welded.node_of_vertex == std::vector<int>{-1, 0, 1, 0, 2, 1});
  CHECK(welded.mesh.vertices == std::vector<Vec3>{{1, 0, 0}, {0, 0, 0}, {0, 1, 0}});
  CHECK(welded.mesh.triangles == std::vector<Triangle>{{1, 0, 2}, {1, 0, 2}});
}

TEST_CASE("positions that differ in the last bit stay apart") {
  const double next = std::nextafter(1.0, 2.0);
  const TriangleMesh mesh{{{1, 0, 0}, {next, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  CHECK(weld(mesh).mesh.vertices.size() == 3);
}
