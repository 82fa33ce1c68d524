#include "mesh/adjacency.hpp"
#include "mesh_test.hpp"

using namespace bem;

TEST_CASE("twins run the same edge the other way") {
  const std::vector<Triangle> triangles = test::unit_tetrahedron().triangles;
  const std::vector<int> twins = half_edge_twins(triangles);
  REQUIRE(twins.size() == 12);
  for (int h = 0; h < 12; ++h) {
    const auto from = [&](int e) { return triangles[e / 3][e % 3]; };
    const auto to = [&](int e) { return triangles[e / 3][(e + 1) % 3]; };
    CHECK(twins[h] / 3 != h / 3);
    CHECK(twins[twins[h]] == h);
    CHECK(from(twins[h]) == to(h));
    CHECK(to(twins[h]) == from(h));
  }
}

TEST_CASE("twins of an open or inconsistent surface are a broken invariant") {
  std::vector<Triangle> triangles = test::unit_tetrahedron().triangles;
  std::swap(triangles[1][0], triangles[1][1]);
  test::error_message(ErrorCode::internal, [&] { half_edge_twins(triangles); });
  triangles.pop_back();
  test::error_message(ErrorCode::internal, [&] { half_edge_twins(triangles); });
}

TEST_CASE("edges are visited once with all their half-edges") {
  // Three triangles at edge 0-1, every other edge has one.
  const auto half_edges = sorted_half_edges({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  std::vector<long> sizes;
  for_each_edge(half_edges, [&](const HalfEdge* first, const HalfEdge* last) {
    sizes.push_back(last - first);
    if (last - first == 3) {
      CHECK(first[0].index == 0);
      CHECK(first[1].index == 3);
      CHECK(first[2].index == 6);
      CHECK(first[0].forward);
      CHECK_FALSE(first[1].forward);
    }
  });
  CHECK(sizes == std::vector<long>{3, 1, 1, 1, 1, 1, 1});
}
