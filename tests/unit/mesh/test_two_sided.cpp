#include "mesh/adjacency.hpp"
#include "mesh/components.hpp"
#include "mesh/shapes.hpp"
#include "mesh/two_sided.hpp"
#include "mesh_test.hpp"

using namespace bem;

namespace {

/// Both sides of every triangle, and edges with one or two triangles of consistent orientation.
void check_layers(const TriangleMesh& mesh, const TwoSided& sides) {
  REQUIRE(sides.layers.triangles.size() == 2 * mesh.triangles.size());
  REQUIRE(sides.offsets.size() == sides.layers.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 normal = triangle_normal(mesh, mesh.triangles[t]);
    const Vec3 front = triangle_normal(sides.layers, sides.layers.triangles[2 * t]);
    const Vec3 back = triangle_normal(sides.layers, sides.layers.triangles[2 * t + 1]);
    CHECK((front - normal).norm() < 1e-14);
    CHECK((back + normal).norm() < 1e-14);
  }
  std::vector<Triangle> all = sides.layers.triangles;
  all.insert(all.end(), sides.rim.begin(), sides.rim.end());
  for_each_edge(sorted_half_edges(all), [&](const HalfEdge* first, const HalfEdge* last) {
    CHECK(last - first <= 2);
    if (last - first == 2) CHECK(first[0].forward != first[1].forward);
  });
}

std::size_t rim_edges(const TwoSided& sides) {
  std::size_t count = 0;
  for_each_edge(sorted_half_edges(sides.layers.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) { count += last - first == 1; });
  return count;
}

}  // namespace

TEST_CASE("a flat sheet has two layers that share nothing") {
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const TwoSided sides = make_two_sided(mesh);
  check_layers(mesh, sides);
  CHECK(sides.layers.vertices.size() == 8);
  CHECK(rim_edges(sides) == 8);
  CHECK(sides.rim.size() == 8);
  for (std::size_t v = 0; v < 8; ++v) CHECK(std::abs(sides.offsets[v].norm() - 1) < 1e-14);
}

TEST_CASE("sheets that meet in an edge are layers of the wedges between them") {
  // three leaves of one hinge, and two sheets that face each other's back
  const TriangleMesh hinge{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}},
                           {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}};
  const TwoSided sides = make_two_sided(hinge);
  check_layers(hinge, sides);
  CHECK(sides.layers.vertices.size() == 3 * 4);  // one sheet of two triangles for every wedge
  CHECK(rim_edges(sides) == 3 * 4);
  const TriangleMesh against{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 3, 2}}};
  check_layers(against, make_two_sided(against));
  CHECK(make_two_sided(against).layers.vertices.size() == 8);
}

TEST_CASE("a fin on one edge of a sheet does not tie the wedges beside it together") {
  TriangleMesh mesh;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) mesh.vertices.emplace_back(i, j, 0);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const int a = 3 * i + j;
      mesh.triangles.push_back({a, a + 3, a + 4});
      mesh.triangles.push_back({a, a + 4, a + 1});
    }
  mesh.vertices.emplace_back(1, 0.5, 1);
  mesh.triangles.push_back({3, 4, 9});  // the edge from (1, 0, 0) to (1, 1, 0)
  check_layers(mesh, make_two_sided(mesh));
}

TEST_CASE("a sheet whose layers are moved apart is a closed surface") {
  TriangleMesh mesh;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) mesh.vertices.emplace_back(i, j, 0.1 * i * j);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      if (i == 1 && j == 1) continue;  // a hole
      const int a = 4 * i + j;
      mesh.triangles.push_back({a, a + 4, a + 5});
      mesh.triangles.push_back({a, a + 5, a + 1});
    }
  TwoSided sides = make_two_sided(mesh);
  check_layers(mesh, sides);
  CHECK(sides.rim.size() == 2 * 16);
  sides.layers.triangles.insert(sides.layers.triangles.end(), sides.rim.begin(), sides.rim.end());
  for_each_edge(sorted_half_edges(sides.layers.triangles),
                [&](const HalfEdge* first, const HalfEdge* last) { CHECK(last - first == 2); });
  double volume = 0;
  for (std::size_t v = 0; v < sides.offsets.size(); ++v)
    sides.layers.vertices[v] += 1e-4 * sides.offsets[v];
  for (const Component& c : surface_components(sides.layers)) volume += c.volume;
  CHECK(volume == Approx(2e-4 * surface_area(mesh)).epsilon(1e-3));
}

TEST_CASE("offsets move every triangle by their length along its normal") {
  TriangleMesh roof{{{0, 0, 0}, {0, 1, 0}, {1, 0, -1}, {1, 1, -1}, {-1, 0, -1}, {-1, 1, -1}},
                    {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}}};
  TwoSided sides = make_two_sided(roof);
  check_layers(roof, sides);
  const TriangleMesh before = sides.layers;
  for (std::size_t v = 0; v < sides.offsets.size(); ++v)
    sides.layers.vertices[v] += 1e-3 * sides.offsets[v];
  for (const Triangle& t : before.triangles)
    for (int v : t)
      CHECK(triangle_normal(before, t).dot(sides.layers.vertices[v] - before.vertices[v]) ==
            Approx(1e-3));
}
