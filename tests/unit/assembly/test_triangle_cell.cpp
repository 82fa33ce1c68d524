#include "assembly/edge_reconstruction.hpp"
#include "assembly/triangle_cell.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("shape functions of a triangle by those of a part of it") {
  const TriangleCell whole({Vec3(0, 0, 0), Vec3(2, 0.1, 0), Vec3(0.3, 1, 0.2)});
  CHECK(whole.shapes() == Eigen::Matrix<double, 6, 6>::Identity());
  const TriangleCell cell = whole.half(0).half(1).half(1);
  CHECK(cell.part() == 0.125);

  const double in_cell[3] = {0.2, 0.5, 0.3};
  double in_triangle[3];
  cell.to_triangle(in_cell, in_triangle);
  CHECK((cell.position(in_cell) - whole.position(in_triangle)).norm() < 1e-15);
  const auto of_cell = quadratic_shapes(in_cell), of_triangle = quadratic_shapes(in_triangle);
  for (int a = 0; a < 6; ++a) {
    double value = 0;
    for (int b = 0; b < 6; ++b) value += cell.shapes()(a, b) * of_cell[b];
    CHECK(value == Approx(of_triangle[a]).margin(1e-15));
  }
}

TEST_CASE("halves of a triangle cut its longest edge") {
  const TriangleCell whole({Vec3(0, 0, 0), Vec3(2, 0.5, 0), Vec3(4, 0, 0)});
  for (int i = 0; i < 2; ++i) {
    const TriangleCell half = whole.half(i);
    CHECK(half.part() == 0.5);
    CHECK(half.longest_edge() < 2.1);
    const auto& c = half.corners();
    CHECK(0.5 * (c[1] - c[0]).cross(c[2] - c[0]).norm() == Approx(0.5));
  }
}
