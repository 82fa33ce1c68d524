#include "broken_meshes.hpp"
#include "repair/soup.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("vertices within a distance are joined, those farther apart are not") {
  TriangleMesh soup = soup_of(icosphere(1, 1));
  for (std::size_t v = 0; v < soup.vertices.size(); ++v)
    soup.vertices[v] += 1e-7 * Vec3(v % 3, v % 5, v % 2);
  TriangleMesh joined = soup;
  CHECK(weld_within(joined, 1e-5) > 100);
  CHECK(joined.vertices.size() == 42);
  CHECK(count_bad_edges(joined).total() == 0);
  CHECK(weld_within(soup, 1e-9) < 100);
  CHECK(count_bad_edges(soup).open > 0);
}

TEST_CASE("only vertices of open edges are joined along seams") {
  TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 1e-3}, {0, 1, 1e-3}, {1, 1, 0}},
                    {{0, 1, 2}, {4, 3, 5}}};
  CHECK(weld_rims_within(mesh, 2e-3) == 2);
  CHECK(mesh.vertices.size() == 4);
  TriangleMesh closed = box({1, 1, 1e-3}, {1, 1, 1});
  CHECK(weld_rims_within(closed, 2e-3) == 0);
}

TEST_CASE("collapsed triangles are dropped") {
  TriangleMesh mesh = cube();
  mesh.triangles.push_back({3, 3, 1});
  CHECK(drop_collapsed(mesh) == 1);
  CHECK(mesh.triangles.size() == cube().triangles.size());
}

TEST_CASE("edges are split where a vertex lies on them, flat triangles go") {
  TriangleMesh mesh = cube();
  // A triangle of one face is replaced by two that meet in the middle of its first edge.
  const Triangle t = mesh.triangles[0];
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]));
  mesh.triangles[0] = {t[0], middle, t[2]};
  mesh.triangles.push_back({middle, t[1], t[2]});
  TriangleMesh flat = mesh;
  flat.triangles.push_back({middle, t[0], t[1]});
  for (TriangleMesh* broken : {&mesh, &flat}) {
    CHECK(split_edges_at_vertices(*broken, 1e-9) == 1);
    CHECK(broken->triangles.size() == 14);
    CHECK(count_bad_edges(*broken).total() == 0);
  }
}

TEST_CASE("a small fin goes, a large one stays") {
  TriangleMesh mesh = cube();
  const Triangle t = mesh.triangles[0];
  mesh.vertices.push_back(mesh.vertices[t[0]] * 1.1);
  mesh.triangles.push_back({t[0], t[1], static_cast<int>(mesh.vertices.size()) - 1});
  TriangleMesh kept = mesh;
  CHECK(drop_fins(mesh, 0.05) == 1);
  CHECK(count_bad_edges(mesh).total() == 0);
  CHECK(drop_fins(kept, 0.001) == 0);
}
