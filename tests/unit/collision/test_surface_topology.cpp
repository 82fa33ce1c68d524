#include "base/error.hpp"
#include "collision/surface_topology.hpp"
#include "collision_test.hpp"

using namespace bem;

TEST_CASE("edges, fans and owners of a closed mesh") {
  const TriangleMesh mesh = torus(1, 0.3, 12, 7);
  const int vertices = static_cast<int>(mesh.vertices.size());
  const SurfaceTopology topology = make_topology(mesh.triangles, vertices);
  CHECK(topology.vertex_count() == vertices);
  CHECK(topology.edges.size() == 3 * mesh.triangles.size() / 2);
  std::vector<int> vertex_owners(vertices), edge_owners(topology.edges.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.triangles[t][k], w = mesh.triangles[t][(k + 1) % 3];
      const int edge = topology.triangle_edges[t][k];
      const auto& e = topology.edges[edge];
      const bool first = e.triangles[0] == static_cast<int>(t);
      CHECK((first || e.triangles[1] == static_cast<int>(t)));
      CHECK(e.vertices[first ? 0 : 1] == v);
      CHECK(e.vertices[first ? 1 : 0] == w);
      vertex_owners[v] += topology.owned_vertices[t] >> k & 1;
      edge_owners[edge] += topology.owned_edges[t] >> k & 1;
    }
  }
  for (int n : vertex_owners) CHECK(n == 1);
  for (int n : edge_owners) CHECK(n == 1);
  for (int v = 0; v < vertices; ++v) {
    CHECK(topology.fan_begin[v + 1] - topology.fan_begin[v] == 6);
    for (int i = topology.fan_begin[v]; i < topology.fan_begin[v + 1]; ++i) {
      const Triangle& t = mesh.triangles[topology.fan_triangles[i]];
      CHECK((t[0] == v || t[1] == v || t[2] == v));
    }
  }
}

TEST_CASE("a boundary edge has one triangle, more than two are refused") {
  const SurfaceTopology topology = make_topology({{0, 1, 2}, {0, 2, 3}}, 5);
  int boundary = 0;
  for (const auto& e : topology.edges) boundary += e.triangles[1] < 0;
  CHECK(boundary == 4);
  CHECK(topology.fan_begin[5] == topology.fan_begin[4]);  // an unused vertex
  CHECK_THROWS_AS(make_topology({{0, 1, 2}, {0, 1, 3}}, 4), Error);
  CHECK_THROWS_AS(make_topology({{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}, 5), Error);
  CHECK_THROWS_AS(make_topology({{0, 1, 2}}, 2), Error);
}
