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

/// The static kernels between x and the points of y: static_[y][kernel], K'(0) times the area of y.
template <class T>
void MidpointPatches<T>::evaluate(const PatchPair& pair, const Midpoint& x) {
  const std::vector<Midpoint>& y = pair.y.midpoints;
  const StaticTraction traction(pair.integrals.material().kappa());
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  static_.resize(y.size() * kStaticKernels);
  for (std::size_t first = 0; first < y.size(); first += StaticBatch::kCapacity) {
    const std::size_t end = std::min(y.size(), first + StaticBatch::kCapacity);
    static_batch_.size = 0;
    for (std::size_t q = first; q < end; ++q) static_batch_.add(y[q].place - x.place);
    evaluate_static(x.normal, traction, static_batch_, values);
    for (std::size_t q = first; q < end; ++q)
      for (std::size_t k = 0; k < kStaticKernels; ++k)
        static_[q * kStaticKernels + k] =
            (k < StaticSums::kScalar ? y[q].area : 1) * values[k][q - first];
  }
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
void MidpointPatches<T>::add_static_h(const PatchPair& pair, const std::vector<int>& places,
                                      BlockSums<T>& to) {
  const Material& material = pair.integrals.material();
  const std::size_t nodes = to.nodes, rows = places.size();
  const double kappa = material.kappa(), scale = pair.h_part * material.shear_modulus / (4 * kPi);
  for (int axis = 0; axis < 3; ++axis) {
    combined_[axis].resize(rows * nodes * kForms);
    combine_rows(pair.rows.curls_at[axis], curls_[axis].data(), nodes * kForms,
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
void MidpointPatches<T>::add_dynamic(const PatchPair& pair, const LaneTable<T>& table,
                                     const std::vector<int>& places, BlockSums<T>& to) {
  const SurfacePatch& y = pair.y;
  const std::vector<Midpoint>& x = pair.x.midpoints;
  const std::size_t entry = 9 * to.lanes, nodes = to.nodes, hats = to.hats;
  uniform_.resize(MidpointSums<T>::kUniform * to.lanes);
  adjoint_.resize(y.midpoints.size() * entry);
  adjoint_of_x_.resize(x.size() * hats * entry);
  set_zero(strain_of_x_, x.size() * 2 * entry);
  if (pair.with_h()) {
    inertia_.resize(y.midpoints.size() * entry);
    inertia_of_x_.resize(x.size() * nodes * entry);
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    for_each_batch(x[i].place, y.midpoints, batch_, [&](std::size_t first) {
      evaluate_midpoints(table, pair.integrals.scales(), x[i].normal, batch_, scratch_,
                         {to.lanes, pair.with_h() ? &inertia_[first * entry] : nullptr,
                          &adjoint_[first * entry], uniform_.data()});
      add_strain_of_midpoints(pair.integrals, uniform_.data(), to.lanes,
                              &strain_of_x_[i * 2 * entry]);
    });
    combine_rows(y.tractions_at, adjoint_.data(), entry, &adjoint_of_x_[i * hats * entry]);
    if (pair.with_h())
      combine_rows(y.displacements_at, inertia_.data(), entry, &inertia_of_x_[i * nodes * entry]);
  }
  const SparseRows& rows = pair.rows.midpoints;
  add_combined_rows(rows, adjoint_of_x_.data(), hats * entry, 1, places, to.adjoint.data());
  add_combined_rows(rows, strain_of_x_.data(), 2 * entry, 1, places, to.strain.data());
  if (pair.with_h())
    add_combined_rows(rows, inertia_of_x_.data(), nodes * entry, pair.h_part, places,
                      to.inertia.data());
}

template <class T>
void MidpointPatches<T>::add_static(const PatchPair& pair, const std::vector<int>& places,
                                    BlockSums<T>& to) {
  constexpr std::size_t kStatic = BlockSums<T>::kStaticEntry;
  const std::vector<Midpoint>& x = pair.x.midpoints;
  const std::size_t nodes = to.nodes, hats = to.hats;
  static_g_of_x_.resize(x.size() * hats * kStatic);
  if (pair.with_h())
    for (AlignedVector<double>& of_axis : curls_) of_axis.resize(x.size() * nodes * kForms);
  for (std::size_t i = 0; i < x.size(); ++i) {
    evaluate(pair, x[i]);
    combine_rows(pair.y.tractions_at, static_.data(), kStaticKernels, kStatic,
                 &static_g_of_x_[i * hats * kStatic]);
    if (pair.with_h()) combine_curls(pair.y, i);
  }
  add_combined_rows(pair.rows.midpoints, static_g_of_x_.data(), hats * kStatic, -1, places,
                    to.static_g.data());
  if (pair.with_h()) add_static_h(pair, places, to);
}

template class MidpointPatches<float>;
template class MidpointPatches<double>;

}  // namespace bem
