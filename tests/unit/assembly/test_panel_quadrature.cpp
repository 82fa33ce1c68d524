#include "assembly/panel_quadrature.hpp"
#include "support/bodies.hpp"
#include "support/collocation_kernels.hpp"
#include "support/reference.hpp"

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
            if (b.far)
              CHECK(Vec3(b.r[0][q], b.r[1][q], b.r[2][q]).norm() >
                    2 * longest_edge(mesh, mesh.triangles[t]));
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

namespace {

/// Kernels integrated over one triangle, and their static sizes, which the tolerance refers to.
struct Integrals {
  Eigen::Matrix3cd u[3], p[3], d = Eigen::Matrix3cd::Zero(), l = d;
  double u_size[3] = {}, p_size[3] = {}, d_size = 0, l_size = 0;
};

Integrals integrate(const PanelQuadrature& quadrature, int vertex, const Material& m, Complex s) {
  const double c2 = m.shear_speed();
  const RadialValues<double> rest = static_radial_values(m.kappa());
  Integrals sum;
  for (int a = 0; a < 3; ++a) sum.u[a] = sum.p[a] = Eigen::Matrix3cd::Zero();
  PointBatch scratch;
  quadrature.for_each_batch(vertex, 0, scratch, [&](const PointBatch& batch) {
    for (int q = 0; q < batch.size; ++q) {
      const Vec3 r(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
      const PairGeometry pair = pair_geometry(Vec3::Zero(), r, quadrature.normal(0));
      const RadialValues<Complex> v = radial_values(s * pair.r / c2, m.kappa());
      for (int a = 0; a < 3; ++a) {
        const double weight = batch.shape_weight[a][q];
        sum.u[a] += weight * displacement_kernel(pair, v, m.shear_modulus);
        sum.p[a] += weight * traction_kernel(pair, v);
        sum.d += weight * translation_kernel(pair, v, c2);
        sum.l += weight * rotation_kernel(pair, v, c2);
        sum.u_size[a] += weight * displacement_kernel(pair, rest, m.shear_modulus).norm();
        sum.p_size[a] += weight * traction_kernel(pair, rest).norm();
        sum.d_size += weight * translation_kernel(pair, rest, c2).norm();
        sum.l_size += weight * rotation_kernel(pair, rest, c2).norm();
      }
    }
  });
  return sum;
}

}  // namespace

TEST_CASE("panels are integrated to the tolerance") {
  // from points beside the triangle, against high-precision integrals
  const json data = load_reference("triangle_integrals.json");
  int count = 0;
  for (const json& e : data["integrals"]) {
    if (e["kind"] != "regular") continue;
    ++count;
    TriangleMesh mesh;
    for (const json& corner : e["tri"]) mesh.vertices.push_back(vec3(corner));
    mesh.vertices.push_back(vec3(e["x"]));
    mesh.triangles = {{0, 1, 2}};
    const Material m = material(number(e["rho"]), number(e["mu"]), number(e["nu"]));
    const Complex s = complex(e["s"]);
    for (double tolerance : {1e-4, 1e-6, 1e-8}) {
      const PanelQuadrature quadrature(mesh, tolerance, std::abs(s) / m.shear_speed());
      const Integrals sum = integrate(quadrature, 3, m, s);
      INFO("s " << s << ", nu " << m.poisson_ratio << ", tolerance " << tolerance);
      for (int a = 0; a < 3; ++a) {
        CHECK((sum.u[a] - matrix3(e["u"][a])).norm() < tolerance * sum.u_size[a]);
        CHECK((sum.p[a] - matrix3(e["p"][a])).norm() < tolerance * sum.p_size[a]);
      }
      CHECK((sum.d - matrix3(e["d"][0])).norm() < tolerance * sum.d_size);
      CHECK((sum.l - matrix3(e["l"][0])).norm() < tolerance * sum.l_size);
    }
  }
  CHECK(count == 24);
}
