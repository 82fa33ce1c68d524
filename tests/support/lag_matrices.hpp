#pragma once

#include "assembly/row_assembler.hpp"
#include "mesh/extent.hpp"

namespace bem_test {

/// The assembled matrices of all lags, by lane (LaneLayout).
struct LagMatrices {
  std::vector<Eigen::MatrixXd> h, g;  ///< 3N x 3N
  std::vector<Eigen::MatrixXd> d, q;  ///< 3N x 3
  std::vector<Eigen::MatrixXd> c;     ///< 3N x 6
  double residual = 0;                ///< largest entry that the own-block fix changed
};

/// All rows of the production assembler; T = float sums far panels in single precision.
template <class T = double>
LagMatrices assemble_all(const bem::TriangleMesh& mesh, const bem::Discretisation& d, bool fix) {
  const bem::RowAssembler assembler(mesh, bem::diameter(mesh.vertices), d);
  const int n = static_cast<int>(mesh.vertices.size());
  const int lanes = assembler.layout().count();
  LagMatrices out;
  out.h.assign(lanes, Eigen::MatrixXd::Zero(3 * n, 3 * n));
  out.g = out.h;
  out.d.assign(lanes, Eigen::MatrixXd::Zero(3 * n, 3));
  out.q = out.d;
  out.c.assign(lanes, Eigen::MatrixXd::Zero(3 * n, 6));
  bem::RowAssembler::Workspace work;
  bem::BlockRow<T> row;
  constexpr int kSymmetric[9] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
  for (int i = 0; i < n; ++i) {
    out.residual = std::max(out.residual, assembler.assemble(i, fix, work, row));
    for (int lane = 0; lane < lanes; ++lane)
      for (int e = 0; e < 18; ++e)
        out.c[lane](3 * i + e / 6, e % 6) = row.c[e * row.padded_lanes + lane];
    for (int lane = 0; lane < lanes; ++lane)
      for (int e = 0; e < 9; ++e) {
        const int r = 3 * i + e / 3, c = e % 3;
        out.d[lane](r, c) = row.d[e * row.padded_lanes + lane];
        out.q[lane](r, c) = row.q[e * row.padded_lanes + lane];
        for (int j = 0; j < n; ++j) {
          out.h[lane](r, 3 * j + c) = row.h_block(j)[e * row.padded_lanes + lane];
          out.g[lane](r, 3 * j + c) = row.g_block(j)[kSymmetric[e] * row.padded_lanes + lane];
        }
      }
  }
  return out;
}

/// The s x s stage matrix of lag k from the lanes of one number.
inline bem::StageMatrix stage_matrix(const bem::Scheme& scheme, const bem::LaneLayout& layout,
                                     const double* lanes, int k) {
  bem::StageMatrix x = bem::StageMatrix::Zero(scheme.stages(), scheme.stages());
  if (k == 0) {
    int lane = 0;
    for (const bem::InitialComponent& c : scheme.initial_components()) {
      const bem::Complex value(lanes[lane], c.paired ? lanes[lane + 1] : 0.0);
      x += c.multiplicity() * (value * c.left * c.right.transpose()).real();
      lane += c.paired ? 2 : 1;
    }
    return x;
  }
  for (int m = 0; m < layout.components; ++m) {
    const bem::LagComponent& c = scheme.lag_components()[m];
    x += lanes[layout.lane(k, m)] * c.left * c.right.transpose();
  }
  return x;
}

}  // namespace bem_test
