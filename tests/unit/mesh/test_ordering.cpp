#include "mesh/ordering.hpp"
#include "mesh/shapes.hpp"
#include "mesh_test.hpp"

#include <algorithm>

using namespace bem;

namespace {

std::vector<Vec3> grid(int n) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) points.emplace_back(i, j, k);
  return points;
}

std::vector<int> sorted(std::vector<int> order) {
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace

TEST_CASE("the curve visits the cells of a grid one neighbour after the other") {
  for (int n : {2, 4, 8, 16}) {
    // Corners of the cells would fall between cells; a point beyond each end keeps them apart.
    std::vector<Vec3> points = grid(n);
    for (Vec3& p : points) p += Vec3::Constant(0.5);
    points.push_back(Vec3::Zero());
    points.push_back(Vec3::Constant(n));
    const std::vector<int> order = hilbert_order(points);
    std::vector<int> inner;
    for (int i : order)
      if (i < n * n * n) inner.push_back(i);
    REQUIRE(inner.size() == static_cast<std::size_t>(n * n * n));
    for (std::size_t k = 1; k < inner.size(); ++k)
      REQUIRE((points[inner[k]] - points[inner[k - 1]]).norm() == Approx(1.0));
  }
}

TEST_CASE("the order is a permutation, stable for equal points") {
  std::vector<Vec3> points = icosphere(2, 1.0).vertices;
  const std::size_t n = points.size();
  points.insert(points.end(), points.begin(), points.end());
  const std::vector<int> order = hilbert_order(points);
  const std::vector<int> all = sorted(order);
  for (std::size_t i = 0; i < all.size(); ++i) REQUIRE(all[i] == static_cast<int>(i));
  for (std::size_t k = 0; k < order.size(); k += 2)
    REQUIRE(order[k + 1] == order[k] + static_cast<int>(n));
}

TEST_CASE("degenerate point sets have an order too") {
  CHECK(hilbert_order({}).empty());
  CHECK(hilbert_order({{1, 2, 3}}) == std::vector<int>{0});
  CHECK(hilbert_order({{1, 2, 3}, {1, 2, 3}}) == std::vector<int>{0, 1});
  CHECK(sorted(hilbert_order({{0, 0, 1}, {0, 0, 3}, {0, 0, 2}})) == std::vector<int>{0, 1, 2});
}

TEST_CASE("neighbours in the order are near in space") {
  const std::vector<Vec3> points = icosphere(4, 1.0).vertices;  // spacing about 0.07
  const std::vector<int> order = hilbert_order(points);
  double total = 0;
  for (std::size_t k = 1; k < order.size(); ++k)
    total += (points[order[k]] - points[order[k - 1]]).norm();
  CHECK(total / static_cast<double>(order.size()) < 0.12);
}
