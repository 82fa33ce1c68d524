#include "assembly/midpoint_patches.hpp"

#include "assembly/lane_rows.hpp"
#include "assembly/midpoint_strain.hpp"

namespace bem {
namespace {

/// Of static kernels at a point y: K'(0), then 1/r and h h^T/r.
constexpr std::size_t kStaticKernels = StaticSums::kCount;
/// The last entry of K'(0) and the kernels behind it are whole vectors.
constexpr std::size_t kFirstForm = 8, kFormVector = kStaticKernels - kFirstForm;
static_assert(StaticSums::kAdjoint == 0 && StaticSums::kScalar == kFirstForm + 1);

}  // namespace

/// The kernels between x and the points of y, static_[y][kernel] with K'(0) times the area of y;
/// adds J of uniform strain to `strain`.
template <class T>
void MidpointPatches<T>::evaluate(const PairIntegrals& pairs, const Midpoint& x,
                                  const SurfacePatch& y, const LaneTable<T>& table,
                                  std::size_t lanes, bool with_h, T* strain) {
  const std::size_t entry = 9 * lanes;
  const StaticTraction traction(pairs.material().kappa());
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  for_each_batch(x, y.midpoints, batch_, [&](std::size_t first) {
    evaluate_midpoints(table, pairs.scales(), x.normal, batch_, scratch_,
                       {lanes, with_h ? &inertia_[first * entry] : nullptr,
                        &adjoint_[first * entry], uniform_.data()});
    add_strain_of_midpoints(pairs, uniform_.data(), lanes, strain);
    static_batch_.size = 0;
    for (int q = 0; q < batch_.size; ++q)
      static_batch_.add({batch_.r[0][q], batch_.r[1][q], batch_.r[2][q]});
    evaluate_static(x.normal, traction, static_batch_, values);
    for (int q = 0; q < batch_.size; ++q) {
      double* to = &static_[(first + static_cast<std::size_t>(q)) * kStaticKernels];
      const double area = batch_.area[q], there = area > 0 ? 1 : 0;
      for (std::size_t k = 0; k < kStaticKernels; ++k)
        to[k] = (k <= kFirstForm ? area : there) * values[k][q];
    }
  });
}

/// The static kernels of D(0) between point x and the nodes of y, arranged as add_static_h() needs
/// them.
template <class T>
void MidpointPatches<T>::combine_curls(const SurfacePatch& y, std::size_t x) {
  const std::size_t nodes = y.nodes.size();
  for (int axis = 0; axis < 3; ++axis) {
    by_axis_[axis].resize(nodes * kFormVector);
    combine_rows(y.curls_at[axis], static_.data() + kFirstForm, kStaticKernels, kFormVector,
                 by_axis_[axis].data());
  }
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t node = 0; node < nodes; ++node) {
      double* to = &curls_[axis][(x * nodes + node) * kForms];
      std::copy_n(&by_axis_[axis][node * kFormVector + 1], 7, to);
      to[7] = by_axis_[(axis + 1) % 3][node * kFormVector + 1];
      to[8] = by_axis_[(axis + 2) % 3][node * kFormVector + 1];
      std::fill(to + 9, to + kForms, 0.0);
    }
}

/// D(0) is bilinear in surface curls (static_hypersingular_kernel()).
template <class T>
void MidpointPatches<T>::add_static_h(const Material& material, const PatchRows& wanted,
                                      double h_part, const std::vector<int>& places,
                                      BlockSums<T>& to) {
  const std::size_t nodes = to.nodes, rows = wanted.rows.size();
  const double kappa = material.kappa(), scale = h_part * material.shear_modulus / (4 * kPi);
  for (int axis = 0; axis < 3; ++axis) {
    combined_[axis].resize(rows * nodes * kForms);
    combine_rows(wanted.curls_at[axis], curls_[axis].data(), nodes * kForms,
                 combined_[axis].data());
  }
  constexpr int kTensorEntry[9] = {1, 2, 3, 2, 4, 5, 3, 5, 6};
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t node = 0; node < nodes; ++node) {
      const std::size_t at = (k * nodes + node) * kForms;
      const double* of[3] = {&combined_[0][at], &combined_[1][at], &combined_[2][at]};
      double sum[7];
      for (int i = 0; i < 7; ++i) sum[i] = of[0][i] + of[1][i] + of[2][i];
      const auto crossed = [&](int x_axis, int y_axis) {
        return of[x_axis][y_axis == x_axis ? 0 : y_axis == (x_axis + 1) % 3 ? 7 : 8];
      };
      double* out = &to.static_h[(places[k] * nodes + node) * to.kStaticEntry];
      for (int e = 0; e < 9; ++e) {
        const int r = e / 3, c = e % 3;
        double value = 2 * (1 - kappa) * sum[kTensorEntry[e]] - crossed(r, c) -
                       2 * (1 - 2 * kappa) * crossed(c, r);
        if (r == c) value += 2 * (1 - kappa) * sum[0];
        out[e] += scale * value;
      }
    }
}

template <class T>
void MidpointPatches<T>::add(const PairIntegrals& pairs, const SurfacePatch& x,
                             const PatchRows& wanted, const SurfacePatch& y,
                             const LaneTable<T>& table, double h_part,
                             const std::vector<int>& places, BlockSums<T>& to) {
  const bool with_h = h_part != 0;
  const std::size_t from = x.midpoints.size(), points = y.midpoints.size();
  const std::size_t entry = 9 * to.lanes, nodes = to.nodes, hats = to.hats;
  constexpr std::size_t kStatic = BlockSums<T>::kStaticEntry;
  uniform_.resize(MidpointSums<T>::kUniform * to.lanes);
  adjoint_.resize(points * entry);
  static_.resize(points * kStaticKernels);
  adjoint_of_x_.resize(from * hats * entry);
  static_g_of_x_.resize(from * hats * kStatic);
  set_zero(strain_of_x_, from * 2 * entry);
  if (with_h) {
    inertia_.resize(points * entry);
    inertia_of_x_.resize(from * nodes * entry);
    for (AlignedVector<double>& of_axis : curls_) of_axis.resize(from * nodes * kForms);
  }
  for (std::size_t i = 0; i < from; ++i) {
    evaluate(pairs, x.midpoints[i], y, table, to.lanes, with_h, &strain_of_x_[i * 2 * entry]);
    combine_rows(y.tractions_at, adjoint_.data(), entry, &adjoint_of_x_[i * hats * entry]);
    combine_rows(y.tractions_at, static_.data(), kStaticKernels, kStatic,
                 &static_g_of_x_[i * hats * kStatic]);
    if (!with_h) continue;
    combine_rows(y.displacements_at, inertia_.data(), entry, &inertia_of_x_[i * nodes * entry]);
    combine_curls(y, i);
  }
  const SparseRows& rows = wanted.midpoints;
  add_combined_rows(rows, adjoint_of_x_.data(), hats * entry, 1, places, to.adjoint.data());
  add_combined_rows(rows, strain_of_x_.data(), 2 * entry, 1, places, to.strain.data());
  add_combined_rows(rows, static_g_of_x_.data(), hats * kStatic, -1, places, to.static_g.data());
  if (!with_h) return;
  add_combined_rows(rows, inertia_of_x_.data(), nodes * entry, h_part, places, to.inertia.data());
  add_static_h(pairs.material(), wanted, h_part, places, to);
}

template class MidpointPatches<float>;
template class MidpointPatches<double>;

}  // namespace bem
