#include "support/laplace_assembly.hpp"

#include "assembly/panel_quadrature.hpp"
#include "assembly/vertex_fan.hpp"
#include "base/parallel.hpp"
#include "quadrature/free_term.hpp"
#include "support/collocation_kernels.hpp"

namespace bem {
namespace {

using Mat3c = Eigen::Matrix3cd;

struct Setup {
  Setup(const TriangleMesh& m, const Material& material, Complex laplace, double tolerance)
      : mesh(m),
        s(laplace),
        mu(material.shear_modulus),
        c2(material.shear_speed()),
        kappa(material.kappa()),
        quadrature(m, tolerance, std::abs(laplace) / c2) {}

  /// Calls f(pair, radial values, shape weights, singular) at every point of a triangle.
  template <class F>
  void for_each_point(int vertex, int triangle, PointBatch& scratch, const F& f) const {
    quadrature.for_each_batch(vertex, triangle, scratch, [&](const PointBatch& batch) {
      for (int q = 0; q < batch.size; ++q) {
        const Vec3 r(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
        const PairGeometry pair = pair_geometry(Vec3::Zero(), r, quadrature.normal(triangle));
        const double weights[3] = {batch.shape_weight[0][q], batch.shape_weight[1][q],
                                   batch.shape_weight[2][q]};
        f(pair, radial_values(s * pair.r / c2, kappa), weights, batch.singular);
      }
    });
  }

  const TriangleMesh& mesh;
  Complex s;
  double mu, c2, kappa;
  PanelQuadrature quadrature;
};

void assemble_row(const Setup& setup, const VertexFans& fans, int i, LaplaceMatrices& out) {
  const TriangleMesh& mesh = setup.mesh;
  const RadialValues<double> rest = static_radial_values(setup.kappa);
  PointBatch scratch;
  Mat3c d = Mat3c::Zero(), l = Mat3c::Zero();
  Eigen::Matrix<Complex, 3, 6> m = Eigen::Matrix<Complex, 3, 6>::Zero();
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    Mat3c h[3], g[3];
    for (int a = 0; a < 3; ++a) h[a] = g[a] = Mat3c::Zero();
    setup.for_each_point(
        i, t, scratch,
        [&](const PairGeometry& pair, RadialValues<Complex> v, const double* w, bool singular) {
          const double weight = w[0] + w[1] + w[2];
          d += weight * translation_kernel(pair, v, setup.c2);
          l += weight * rotation_kernel(pair, v, setup.c2);
          m += weight * strain_kernel(pair, v, setup.c2);
          const Mat3c u = displacement_kernel(pair, v, setup.mu);
          if (singular)
            for (int f : {kRadialP, kRadialQ, kRadialS}) v[f] -= rest[f];
          const Mat3c p = traction_kernel(pair, v);
          for (int a = 0; a < 3; ++a) {
            g[a] += w[a] * u;
            h[a] += w[a] * p;
          }
        });
    for (int a = 0; a < 3; ++a) {
      const int j = mesh.triangles[t][a];
      out.h.block<3, 3>(3 * i, 3 * j) += h[a];
      out.g.block<3, 3>(3 * i, 3 * j) += g[a];
    }
  }
  out.d.block<3, 3>(3 * i, 0) = d;
  out.q.block<3, 3>(3 * i, 0) = l + d * cross_matrix(mesh.vertices[i]).transpose().cast<Complex>();
  out.c.block<3, 6>(3 * i, 0) = m - d * symmetric_products(mesh.vertices[i]).cast<Complex>();
  for (const auto& [j, block] : fans.static_blocks(i, setup.kappa))
    out.h.block<3, 3>(3 * i, 3 * j) += block.cast<Complex>();
}

}  // namespace

LaplaceMatrices laplace_matrices(const TriangleMesh& mesh, const Material& material, Complex s,
                                 double quadrature_tolerance) {
  const Setup setup(mesh, material, s, quadrature_tolerance);
  const VertexFans fans(mesh);
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertices.size());
  LaplaceMatrices out;
  out.h = out.g = Eigen::MatrixXcd::Zero(n, n);
  out.d = out.q = Eigen::MatrixXcd::Zero(n, 3);
  out.c = Eigen::MatrixXcd::Zero(n, 6);
  parallel_for(mesh.vertices.size(),
               [&](std::size_t i) { assemble_row(setup, fans, static_cast<int>(i), out); });
  return out;
}

Eigen::VectorXcd laplace_corner_load(
    const TriangleMesh& mesh, const Material& material, Complex s, double quadrature_tolerance,
    const std::vector<std::array<Eigen::Vector3cd, 3>>& tractions) {
  const Setup setup(mesh, material, s, quadrature_tolerance);
  Eigen::VectorXcd load =
      Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(3 * mesh.vertices.size()));
  parallel_for(mesh.vertices.size(), [&](std::size_t i) {
    PointBatch scratch;
    Eigen::Vector3cd sum = Eigen::Vector3cd::Zero();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      setup.for_each_point(
          static_cast<int>(i), static_cast<int>(t), scratch,
          [&](const PairGeometry& pair, const RadialValues<Complex>& v, const double* w, bool) {
            const Mat3c u = displacement_kernel(pair, v, setup.mu);
            for (int a = 0; a < 3; ++a) sum += w[a] * (u * tractions[t][a]);
          });
    load.segment<3>(static_cast<Eigen::Index>(3 * i)) = sum;
  });
  return load;
}

}  // namespace bem
