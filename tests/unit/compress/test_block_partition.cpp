#include "compress/block_partition.hpp"
#include "mesh/bisection.hpp"
#include "mesh/shapes.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::vector<Vec3> ordered(const std::vector<Vec3>& points) {
  std::vector<Vec3> out;
  for (int i : bisection_order(points)) out.push_back(points[i]);
  return out;
}

}  // namespace

TEST_CASE("blocks tile the matrix, none across a slab") {
  for (int subdivisions : {0, 1, 2, 3}) {
    const std::vector<Vec3> nodes = ordered(icosphere(subdivisions, 1).vertices);
    const int n = static_cast<int>(nodes.size());
    const std::vector<Slab> slabs = make_partition(nodes, {16, 64, 2.0});
    std::vector<int> covered(n * n, 0);
    int next = 0;
    for (const Slab& slab : slabs) {
      CHECK(slab.row_begin == next);
      CHECK(slab.row_end - slab.row_begin <= 64);
      next = slab.row_end;
      for (const NodeBlock& b : slab.blocks) {
        CHECK(b.row_begin >= slab.row_begin);
        CHECK(b.row_end <= slab.row_end);
        for (int i = b.row_begin; i < b.row_end; ++i)
          for (int j = b.column_begin; j < b.column_end; ++j) ++covered[i * n + j];
      }
    }
    CHECK(next == n);
    CHECK(std::all_of(covered.begin(), covered.end(), [](int c) { return c == 1; }));
  }
}

TEST_CASE("far blocks are far, near ones small") {
  const std::vector<Vec3> nodes = ordered(icosphere(3, 1).vertices);
  double near = 0;
  for (const Slab& slab : make_partition(nodes, {16, 64, 1.0}))
    for (const NodeBlock& b : slab.blocks) {
      double nearest = 1e9;
      for (int i = b.row_begin; i < b.row_end; ++i)
        for (int j = b.column_begin; j < b.column_end; ++j)
          nearest = std::min(nearest, (nodes[i] - nodes[j]).norm());
      if (b.far) {
        CHECK(nearest > 0);
      } else {
        near += static_cast<double>(b.rows()) * b.columns();
        CHECK(b.rows() <= 16);
        CHECK(b.columns() <= 16);
      }
    }
  CHECK(near < 0.35 * nodes.size() * nodes.size());
}
