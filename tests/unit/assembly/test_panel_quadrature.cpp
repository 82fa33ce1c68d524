#include "assembly/panel_quadrature.hpp"
#include "support/bodies.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem_test;

TEST_CASE("points of every panel integrate linear functions exactly, near, far and singular") {
  const TriangleMesh mesh = centred(star(1, 1));
  for (double wave_number : {0.0, 30.0}) {
    const PanelQuadrature quadrature(mesh, 1e-6, wave_number);
    PointBatch batch;
    for (int vertex : {0, 17})
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        double area = 0;
        Vec3 moment = Vec3::Zero(), shape = Vec3::Zero();
        quadrature.for_each_batch(vertex, static_cast<int>(t), batch, [&](const PointBatch& b) {
          for (int q = 0; q < b.size; ++q) {
            double weight = 0;
            for (int a = 0; a < 3; ++a) {
              weight += b.shape_weight[a][q];
              shape[a] += b.shape_weight[a][q];
            }
            area += weight;
            moment += weight * Vec3(b.r[0][q], b.r[1][q], b.r[2][q]);
          }
          for (int q = b.size; q < b.padded_size(); ++q) CHECK(b.shape_weight[1][q] == 0);
        });
        const Triangle& tri = mesh.triangles[t];
        const double exact = triangle_area(mesh, tri);
        const double tolerance =
            quadrature.corner_of(vertex, static_cast<int>(t)) >= 0 ? 1e-5 : 1e-13;
        CHECK(std::abs(area - exact) < tolerance * exact);
        CHECK((moment - exact * (triangle_centroid(mesh, tri) - mesh.vertices[vertex])).norm() <
              tolerance * exact * 3);
        for (int a = 0; a < 3; ++a) CHECK(std::abs(shape[a] - exact / 3) < tolerance * exact);
      }
  }
}

TEST_CASE("distance of a point from a triangle") {
  const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  CHECK(point_triangle_distance(Vec3(0.5, 0.5, 3), a, b, c) == Approx(3));
  CHECK(point_triangle_distance(Vec3(-3, 0, 4), a, b, c) == Approx(5));
  CHECK(point_triangle_distance(Vec3(2, 2, 0), a, b, c) == Approx(std::sqrt(2.0)));
  CHECK(point_triangle_distance(Vec3(1, -2, 0), a, b, c) == Approx(2));
}
