// Rows with far panels in single precision against the scalar reference, block by block, on meshes
// that are hard on rounding: thin triangles, lengths in millimetres, far from the origin.
#include "support/bodies.hpp"
#include "support/lag_matrices.hpp"
#include "support/laplace_assembly.hpp"

#include <catch2/catch.hpp>
#include <hwy/highway.h>

using namespace bem;
using namespace bem_test;

namespace {

/// A thin plate with triangles of aspect ratio 12, `scale` times larger, moved by `shift` and back.
TriangleMesh plate(double scale, const Vec3& shift) {
  TriangleMesh mesh = box(scale * Vec3(1, 0.3, 0.02), {6, 3, 1}, 0.5);
  for (Vec3& v : mesh.vertices) v += shift;
  return centred(mesh);
}

/// Static sizes of the blocks of one row: the integrals of the kernels' radial parts without their
/// signs.
struct RowSize {
  std::vector<double> h, g;  ///< by column vertex
  double d = 0, q = 0;
};

RowSize row_size(const TriangleMesh& mesh, const Material& m, int vertex) {
  const PanelQuadrature quadrature(mesh, 1e-3, 0);
  const KernelScales scales(m.shear_modulus, m.shear_speed(), 1);
  const RadialValues<double> rest = static_radial_values(m.kappa());
  const double traction = scales.traction * (std::abs(rest[kRadialP]) + std::abs(rest[kRadialQ]) +
                                             std::abs(rest[kRadialS]));
  RowSize size;
  size.h.assign(mesh.vertices.size(), 0);
  size.g = size.h;
  size.h[vertex] = 0.5;  // the free term
  PointBatch scratch;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    quadrature.for_each_batch(vertex, t, scratch, [&](const PointBatch& batch) {
      for (int q = 0; q < batch.size; ++q) {
        const double r = Vec3(batch.r[0][q], batch.r[1][q], batch.r[2][q]).norm();
        for (int a = 0; a < 3; ++a) {
          const double w = batch.shape_weight[a][q];
          size.h[mesh.triangles[t][a]] += w * traction / (r * r);
          size.g[mesh.triangles[t][a]] += w * scales.displacement / r;
          size.d += w * scales.body_force;
          size.q += w * scales.body_force * (r + mesh.vertices[vertex].norm());
        }
      }
    });
  return size;
}

/// Worst difference between lane a_lane of a and lane b_lane of b over all blocks, each relative
/// to its static size.
double worst_difference(const LagMatrices& a, int a_lane, const LagMatrices& b, int b_lane,
                        const std::vector<RowSize>& sizes) {
  const int n = static_cast<int>(sizes.size());
  const auto block = [](const std::vector<Eigen::MatrixXd>& x, int lane,
                        const std::vector<Eigen::MatrixXd>& y, int other, int i, int j) {
    const Mat3 difference = x[lane].block<3, 3>(3 * i, 3 * j) - y[other].block<3, 3>(3 * i, 3 * j);
    return difference.cwiseAbs().maxCoeff();
  };
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      worst = std::max({worst, block(a.h, a_lane, b.h, b_lane, i, j) / sizes[i].h[j],
                        block(a.g, a_lane, b.g, b_lane, i, j) / sizes[i].g[j]});
    worst = std::max({worst, block(a.d, a_lane, b.d, b_lane, i, 0) / sizes[i].d,
                      block(a.q, a_lane, b.q, b_lane, i, 0) / sizes[i].q,
                      block(a.c, a_lane, b.c, b_lane, i, 0) / sizes[i].q,
                      block(a.c, a_lane, b.c, b_lane, i, 1) / sizes[i].q});
  }
  return worst;
}

/// The scalar complex reference of lag 0, as two lanes.
LagMatrices reference(const TriangleMesh& mesh, const Discretisation& d) {
  const Complex s = d.scheme.initial_components()[0].eigenvalue / d.dt;
  const LaplaceMatrices m = laplace_matrices(mesh, d.material, s, 1e-9);
  LagMatrices out;
  out.h = {m.h.real(), m.h.imag()};
  out.g = {m.g.real(), m.g.imag()};
  out.d = {m.d.real(), m.d.imag()};
  out.q = {m.q.real(), m.q.imag()};
  out.c = {m.c.real(), m.c.imag()};
  return out;
}

/// Every instruction set, the scalar one included, against the reference at lag 0 and, at the later
/// lags, single against double precision.
void check_rows(const TriangleMesh& mesh, const Discretisation& d) {
  std::vector<RowSize> sizes;
  for (int i = 0; i < static_cast<int>(mesh.vertices.size()); ++i)
    sizes.push_back(row_size(mesh, d.material, i));
  const LagMatrices exact = reference(mesh, d);
  for (int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    INFO(hwy::TargetName(target));
    const LagMatrices rows = assemble_all<float>(mesh, d, false);
    const LagMatrices twice = assemble_all<double>(mesh, d, false);
    for (int lane : {0, 1}) {
      CHECK(worst_difference(twice, lane, exact, lane, sizes) < 1e-6);
      CHECK(worst_difference(rows, lane, exact, lane, sizes) < 1e-6);
    }
    for (int lane = 0; lane < static_cast<int>(rows.h.size()); ++lane)
      CHECK(worst_difference(rows, lane, twice, lane, sizes) < 2e-7);
    CHECK(worst_difference(rows, 0, twice, 0, sizes) > 1e-9);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace

TEST_CASE("single precision rows agree with the reference to 1e-6 of the static kernel") {
  Discretisation d;
  d.material = material(1.3, 2.1, 0.4);
  d.history_length = 6;
  SECTION("metres") {
    d.dt = 0.4;
    check_rows(plate(1, Vec3::Zero()), d);
  }
  SECTION("millimetres, far from the origin") {
    d.dt = 400;
    check_rows(plate(1000, Vec3(5e5, -2e5, 8e5)), d);
  }
}
