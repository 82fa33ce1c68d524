#include "assembly/row_assembler.hpp"

#include "assembly/translation_identity.hpp"
#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/symmetric_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace bem {

RowAssembler::RowAssembler(const TriangleMesh& mesh, double extent, const Discretisation& d)
    : mesh_(mesh),
      discretisation_(d),
      table_(d.scheme, d.material.kappa(), 1.000001 * extent / (d.material.shear_speed() * d.dt),
             d.history_length, std::min(1e-10, 1e-3 * d.quadrature_tolerance),
             {d.damping.time / d.dt}),
      far_table_(table_.single_precision()),
      scales_(d.material.shear_modulus, d.material.shear_speed(), d.dt),
      quadrature_(mesh, d.quadrature_tolerance, largest_wave_number(d)),
      fans_(mesh) {
  require(d.dt > 0 && d.history_length >= 0, "dt and the length of the history are possible");
}

double RowAssembler::assemble(int vertex, bool fix_translation, Workspace& work,
                              BlockRow<double>& row) const {
  work.sums.resize(static_cast<std::size_t>(kPanelSums) * table_.lanes().padded_lanes);
  return assemble_row(vertex, fix_translation, work, row, table_.lanes());
}

double RowAssembler::assemble(int vertex, bool fix_translation, Workspace& work,
                              BlockRow<float>& row) const {
  work.sums.resize(static_cast<std::size_t>(kPanelSums) * table_.lanes().padded_lanes);
  work.far_sums.resize(static_cast<std::size_t>(kPanelSums) * far_table_.padded_lanes);
  return assemble_row(vertex, fix_translation, work, row, far_table_);
}

void RowAssembler::sum_panel(int vertex, int triangle, Workspace& work,
                             AlignedVector<double>& sums) const {
  std::fill(sums.begin(), sums.end(), 0.0);
  quadrature_.for_each_batch(vertex, triangle, work.batch, [&](const PointBatch& batch) {
    accumulate_panel(table_.lanes(), scales_, batch, quadrature_.normal(triangle), work.scratch,
                     sums.data());
  });
}

void RowAssembler::sum_panel(int vertex, int triangle, Workspace& work,
                             AlignedVector<float>& sums) const {
  bool near = false;
  quadrature_.for_each_batch(vertex, triangle, work.batch, [&](const PointBatch& batch) {
    const Vec3& normal = quadrature_.normal(triangle);
    if (batch.far) {
      std::fill(sums.begin(), sums.end(), 0.0f);
      accumulate_panel(far_table_, scales_, batch, normal, work.far_scratch, sums.data());
    } else {
      if (!near) std::fill(work.sums.begin(), work.sums.end(), 0.0);
      near = true;
      accumulate_panel(table_.lanes(), scales_, batch, normal, work.scratch, work.sums.data());
    }
  });
  if (!near) return;
  for (int sum = 0; sum < kPanelSums; ++sum)
    for (int lane = 0; lane < far_table_.lanes; ++lane)
      sums[sum * far_table_.padded_lanes + lane] =
          static_cast<float>(work.sums[sum * table_.lanes().padded_lanes + lane]);
}

namespace {

/// q* = l* + d* [x - xbar]^T,  m*(B) - d* B (x - xbar).
template <class T>
void add_arm(const Vec3& x, BlockRow<T>& row) {
  const std::size_t stride = row.padded_lanes;
  const auto add = [&](AlignedVector<double>& out, const auto& factors) {
    const auto columns = static_cast<int>(factors.cols());
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < columns; ++j)
        for (int k = 0; k < 3; ++k)
          for (std::size_t lane = 0; lane < stride; ++lane)
            out[(columns * i + j) * stride + lane] +=
                row.d[(3 * i + k) * stride + lane] * factors(k, j);
  };
  add(row.q, Mat3(cross_matrix(x).transpose()));
  add(row.c, Eigen::Matrix<double, 3, 6>(-symmetric_products(x)));
}

}  // namespace

template <class T>
double RowAssembler::assemble_row(int vertex, bool fix_translation, Workspace& work,
                                  BlockRow<T>& row, const LaneTable<T>& lanes) const {
  const std::size_t stride = lanes.padded_lanes;
  const std::size_t n = mesh_.vertices.size();
  row.padded_lanes = lanes.padded_lanes;
  row.h.assign(n * 9 * stride, T(0));
  row.g.assign(n * 6 * stride, T(0));
  row.d.assign(9 * stride, 0.0);
  row.q.assign(9 * stride, 0.0);
  row.c.assign(18 * stride, 0.0);
  auto& sums = [&work]() -> auto& {
    if constexpr (std::is_same_v<T, float>)
      return work.far_sums;
    else
      return work.sums;
  }
  ();
  // d, l and m sum thousands of panels: in double precision, a few panels at a time
  constexpr std::size_t kPanelsAtATime = 16;
  AlignedVector<T> body(36 * stride, T(0));
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    sum_panel(vertex, static_cast<int>(t), work, sums);
    PanelTarget<T> target;
    for (int a = 0; a < 3; ++a) {
      const std::size_t j = mesh_.triangles[t][a];
      target.h[a] = &row.h[j * 9 * stride];
      target.g[a] = &row.g[j * 6 * stride];
    }
    target.d = body.data();
    target.l = body.data() + 9 * stride;
    target.m = body.data() + 18 * stride;
    add_panel(sums.data(), quadrature_.normal(static_cast<int>(t)), lanes.padded_lanes, target);
    if ((t + 1) % kPanelsAtATime == 0 || t + 1 == mesh_.triangles.size()) {
      for (std::size_t e = 0; e < 9 * stride; ++e) {
        row.d[e] += body[e];
        row.q[e] += body[9 * stride + e];
      }
      for (std::size_t e = 0; e < 18 * stride; ++e) row.c[e] += body[18 * stride + e];
      std::fill(body.begin(), body.end(), T(0));
    }
  }

  add_arm(mesh_.vertices[vertex], row);

  for (const auto& [j, block] : fans_.static_blocks(vertex, table_.kappa()))
    for (int e = 0; e < 9; ++e)
      for (int lane : table_.static_lanes())
        row.h[(static_cast<std::size_t>(j) * 9 + e) * stride + lane] +=
            static_cast<T>(block(e / 3, e % 3));

  return fix_translation ? fix_own_block(vertex, row) : 0;
}

std::vector<Eigen::Matrix3Xd> RowAssembler::assemble_loads(int vertex,
                                                           const std::vector<PanelLoad>& loads,
                                                           Workspace& work) const {
  constexpr int kDisplacementFunctions = 2;  // a and b
  constexpr int kSymmetric[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  const std::size_t stride = table_.lanes().padded_lanes;
  const Eigen::Index cases = loads.empty() ? 0 : loads[0].traction.cols();
  std::vector<Eigen::Matrix3Xd> out(layout().count(), Eigen::Matrix3Xd::Zero(3, cases));
  work.sums.resize(kPanelSums * stride);
  for (const PanelLoad& load : loads) {
    check_interruption();
    std::fill(work.sums.begin(), work.sums.end(), 0.0);
    quadrature_.for_each_batch(vertex, load.triangle, work.batch, [&](const PointBatch& batch) {
      accumulate_panel(table_.lanes(), scales_, batch, quadrature_.normal(load.triangle),
                       work.scratch, work.sums.data(), kDisplacementFunctions);
    });
    for (int lane = 0; lane < layout().count(); ++lane) {
      const auto sum = [&](int first, int step, int offset) {
        double total = 0;  // over all shape functions, which add up to one, or that of a corner
        for (int a = 0; a < 3; ++a)
          if (load.corner.value_or(a) == a)
            total += work.sums[(first + step * a + offset) * stride + lane];
        return total;
      };
      Mat3 block = sum(kSumA, 1, 0) * Mat3::Identity();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block(i, j) += sum(kSumB, 6, kSymmetric[i][j]);
      out[lane].noalias() += block * load.traction;
    }
  }
  return out;
}

template <class T>
double RowAssembler::fix_own_block(int vertex, BlockRow<T>& row) const {
  const std::size_t stride = row.padded_lanes;
  const std::size_t size = 9 * stride;
  std::vector<double> sum(size, 0.0), wanted(stride, 0.0);
  for (std::size_t j = 0; j < mesh_.vertices.size(); ++j)
    for (std::size_t e = 0; e < size; ++e) sum[e] += row.h[j * size + e];
  double largest = 0;
  T* own = &row.h[vertex * size];
  for (int e = 0; e < 9; ++e) {
    translation_row_sums(discretisation_.scheme, layout(), discretisation_.dt, &row.d[e * stride],
                         wanted.data());
    for (int lane = 0; lane < layout().count(); ++lane) {
      const double change = wanted[lane] - sum[e * stride + lane];
      own[e * stride + lane] += static_cast<T>(change);
      largest = std::max(largest, std::abs(change));
    }
  }
  return largest;
}

}  // namespace bem
