#include "assembly/row_assembler.hpp"

#include "assembly/translation_identity.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

double largest_symbol(const Scheme& scheme) {
  double largest = 0;
  constexpr int kSamples = 64;
  for (int i = 0; i <= kSamples; ++i) {
    const StageMatrixC delta = scheme.delta(std::polar(1.0, kPi * i / kSamples));
    for (const Complex& value : delta.eigenvalues()) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

RowAssembler::RowAssembler(const TriangleMesh& mesh, double extent, const Discretisation& d)
    : mesh_(mesh),
      discretisation_(d),
      table_(d.scheme, d.material.kappa(), 1.000001 * extent / (d.material.shear_speed() * d.dt),
             d.history_length, std::min(1e-10, 1e-3 * d.quadrature_tolerance)),
      scales_(d.material.shear_modulus, d.material.shear_speed(), d.dt),
      quadrature_(mesh, d.quadrature_tolerance,
                  largest_symbol(d.scheme) / (d.material.shear_speed() * d.dt)),
      fans_(mesh) {
  require(d.dt > 0 && d.history_length >= 1, "dt is positive and at least one past step is kept");
}

double RowAssembler::assemble(int vertex, bool fix_translation, Workspace& work,
                              BlockRow& row) const {
  const std::size_t stride = table_.padded_lanes();
  const std::size_t n = mesh_.vertices.size();
  row.padded_lanes = table_.padded_lanes();
  row.h.assign(n * 9 * stride, 0.0);
  row.g.assign(n * 6 * stride, 0.0);
  row.d.assign(9 * stride, 0.0);
  row.q.assign(9 * stride, 0.0);
  work.sums.resize(kPanelSums * stride);

  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    const int triangle = static_cast<int>(t);
    const Vec3& normal = quadrature_.normal(triangle);
    std::fill(work.sums.begin(), work.sums.end(), 0.0);
    quadrature_.for_each_batch(vertex, triangle, work.batch, [&](const PointBatch& batch) {
      accumulate_panel(table_, scales_, batch, normal, work.scratch, work.sums.data());
    });
    PanelTarget target;
    for (int a = 0; a < 3; ++a) {
      const std::size_t j = mesh_.triangles[t][a];
      target.h[a] = &row.h[j * 9 * stride];
      target.g[a] = &row.g[j * 6 * stride];
    }
    target.d = row.d.data();
    target.l = row.q.data();
    add_panel(work.sums.data(), normal, table_.padded_lanes(), target);
  }

  // q* = l* + d* [x - xbar]^T
  const Mat3 arm = cross_matrix(mesh_.vertices[vertex]).transpose();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (std::size_t lane = 0; lane < stride; ++lane)
          row.q[(3 * i + j) * stride + lane] += row.d[(3 * i + k) * stride + lane] * arm(k, j);

  for (const auto& [j, block] : fans_.static_blocks(vertex, table_.kappa()))
    for (int e = 0; e < 9; ++e)
      for (int lane : table_.static_lanes())
        row.h[(static_cast<std::size_t>(j) * 9 + e) * stride + lane] += block(e / 3, e % 3);

  return fix_translation ? fix_own_block(vertex, row) : 0;
}

double RowAssembler::fix_own_block(int vertex, BlockRow& row) const {
  const std::size_t stride = table_.padded_lanes();
  const std::size_t size = 9 * stride;
  std::vector<double> sum(size, 0.0), wanted(stride, 0.0);
  for (std::size_t j = 0; j < mesh_.vertices.size(); ++j)
    for (std::size_t e = 0; e < size; ++e) sum[e] += row.h[j * size + e];
  double largest = 0;
  double* own = &row.h[vertex * size];
  for (int e = 0; e < 9; ++e) {
    translation_row_sums(discretisation_.scheme, layout(), discretisation_.dt, &row.d[e * stride],
                         wanted.data());
    for (int lane = 0; lane < layout().count(); ++lane) {
      const double change = wanted[lane] - sum[e * stride + lane];
      own[e * stride + lane] += change;
      largest = std::max(largest, std::abs(change));
    }
  }
  return largest;
}

}  // namespace bem
