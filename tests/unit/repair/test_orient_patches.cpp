#include "broken_meshes.hpp"
#include "mesh/surface.hpp"
#include "repair/orient_patches.hpp"
#include "repair/soup.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("triangles are turned like most of their part") {
  TriangleMesh mesh = shuffled(icosphere(1, 1));
  const OrientedPatches done = orient_patches(mesh);
  CHECK(done.turned == 27);
  CHECK(done.split == 0);
  CHECK(mesh.triangles[1] == icosphere(1, 1).triangles[1]);
  CHECK(make_surface(mesh, "mesh").components.size() == 1);
}

TEST_CASE("parts that touch in a vertex get one each, and are moved apart") {
  TriangleMesh mesh = both(cube(), cube(), {1, 1, 1});
  weld_within(mesh, 0);
  const std::size_t before = mesh.vertices.size();
  CHECK(orient_patches(mesh).split == 1);
  CHECK(mesh.vertices.size() == before + 1);
  CHECK_THROWS(make_surface(mesh, "mesh"));
  CHECK(separate_vertices(mesh, 0.02) == 2);
  CHECK(make_surface(mesh, "mesh").components.size() == 2);
  CHECK(separate_vertices(mesh, 0.02) == 0);
}

TEST_CASE("a strip with one side only is cut open") {
  TriangleMesh strip;
  for (int i = 0; i < 10; ++i) {
    const double a = 0.2 * M_PI * i;
    for (double w : {-0.3, 0.3})
      strip.vertices.emplace_back((1 + w * std::cos(a / 2)) * std::cos(a),
                                  (1 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2));
    const int next = i < 9 ? 2 * i + 2 : 1, other = i < 9 ? 2 * i + 3 : 0;
    strip.triangles.push_back({2 * i, next, other});
    strip.triangles.push_back({2 * i, other, 2 * i + 1});
  }
  CHECK(count_bad_edges(strip).open == 20);
  orient_patches(strip);
  CHECK(count_bad_edges(strip).open == 22);
}
