#include "assembly/close_patches.hpp"

#include "assembly/lane_rows.hpp"

namespace bem {
namespace {

/// to[places[k]][columns[i]] += part from[k][i], `size` numbers each; `to` has `width` columns.
template <class T>
void add_scattered(const std::vector<int>& places, const std::vector<int>& columns, const T* from,
                   std::size_t size, double part, std::size_t width, AlignedVector<T>& to) {
  const T factor = static_cast<T>(part);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const T* a = from + (k * columns.size() + i) * size;
      T* b = &to[(places[k] * width + columns[i]) * size];
      for (std::size_t n = 0; n < size; ++n) b[n] += factor * a[n];
    }
}

/// [shape of x][shape of y][size] -> [shape of x][node of y][size].
template <class T>
void combine_columns(const SparseRows& of_y, std::size_t x_count, std::size_t y_count,
                     const AlignedVector<T>& from, std::size_t size, AlignedVector<T>& to) {
  to.resize(x_count * of_y.rows() * size);
  for (std::size_t x = 0; x < x_count; ++x)
    combine_rows(of_y, &from[x * y_count * size], size, &to[x * of_y.rows() * size]);
}

/// [shape of x][column of y][size] -> [row][column of y][size].
template <class T>
const T* combined(const SparseRows& of_x, const AlignedVector<T>& from, std::size_t size,
                  AlignedVector<T>& to) {
  to.resize(of_x.rows() * size);
  combine_rows(of_x, from.data(), size, to.data());
  return to.data();
}

}  // namespace

template <class T>
typename ClosePatches<T>::Pairs ClosePatches<T>::close_pairs(const PairQuadrature& quadrature,
                                                             const SurfacePatch& x,
                                                             const SurfacePatch& y,
                                                             KernelPart part) {
  Pairs close;
  if (quadrature.midpoints_suffice(distance(x.box, y.box), std::max(x.longest_edge, y.longest_edge),
                                   part))
    return close;
  for (int i = 0; i < static_cast<int>(x.triangles.size()); ++i)
    for (int k = 0; k < static_cast<int>(y.triangles.size()); ++k)
      if (quadrature.is_close(x.triangles[i], y.triangles[k], part)) close.push_back({i, k});
  return close;
}

/// The dynamic sums by the shapes of both.
template <class T>
void ClosePatches<T>::sum(const PairIntegrals& pairs, const SurfacePatch& x, const SurfacePatch& y,
                          const Pairs& close, const LaneTable<T>& table, bool with_h,
                          std::size_t lanes) {
  const std::size_t entry = 9 * lanes, hats = y.hats.size();
  if (with_h) set_zero(inertia_, x.shape_count * y.shape_count * entry);
  set_zero(adjoint_, x.shape_count * hats * entry);
  set_zero(strain_, x.shape_count * 2 * entry);
  const Vector6 pressure = pairs.pressure_of_strain();
  for (const auto& [i, k] : close) {
    set_zero(uniform_, PairSums<T>::kUniform * kShapes * lanes);
    PairSums<T> sums = {};
    sums.lanes = lanes;
    for (int a = 0; a < kShapes; ++a) {
      const std::size_t shape = x.shapes[i][a];
      for (int b = 0; b < kShapes && with_h; ++b)
        sums.inertia[b][a] = &inertia_[(shape * y.shape_count + y.shapes[k][b]) * entry];
      for (int b = 0; b < 3; ++b)
        sums.adjoint[b][a] = &adjoint_[(shape * hats + y.shapes[k][b]) * entry];
      sums.uniform[a] = &uniform_[a * PairSums<T>::kUniform * lanes];
    }
    pairs.add(x.triangles[i], y.triangles[k], PairShare::beyond_midpoints, table, batch_, scratch_,
              sums);
    const Eigen::Matrix<double, 3, 6> tractions =
        pairs.shear_of_strain(pairs.quadrature().normal(y.triangles[k]));
    for (int a = 0; a < kShapes; ++a)
      add_strain(sums.uniform[a], lanes, tractions, pressure, &strain_[x.shapes[i][a] * 2 * entry]);
  }
}

/// The static ones.
template <class T>
void ClosePatches<T>::sum_static(const PairIntegrals& pairs, const SurfacePatch& x,
                                 const SurfacePatch& y, const Pairs& close, bool with_h) {
  constexpr std::size_t kEntry = BlockSums<T>::kStaticEntry;
  const Material& m = pairs.material();
  const std::size_t hats = y.hats.size();
  if (with_h) set_zero(static_h_, x.shape_count * y.shape_count * kEntry);
  set_zero(static_g_, x.shape_count * hats * kEntry);
  for (const auto& [i, k] : close) {
    PairMatrix form = PairMatrix::Zero();
    PairTractions tractions = PairTractions::Zero();
    add_static_pair(pairs.quadrature(), m.shear_modulus, m.kappa(), x.triangles[i], y.triangles[k],
                    PairShare::beyond_midpoints, with_h ? &form : nullptr, tractions);
    for (int a = 0; a < kShapes; ++a)
      for (int e = 0; e < 9; ++e) {
        const int row = 3 * a + e / 3;
        const std::size_t shape = x.shapes[i][a];
        for (int b = 0; b < kShapes && with_h; ++b)
          static_h_[(shape * y.shape_count + y.shapes[k][b]) * kEntry + e] +=
              form(row, 3 * b + e % 3);
        for (int b = 0; b < 3; ++b)
          static_g_[(shape * hats + y.shapes[k][b]) * kEntry + e] += tractions(row, 3 * b + e % 3);
      }
  }
}

template <class T>
void ClosePatches<T>::add(const PairIntegrals& pairs, const SurfacePatch& x,
                          const PatchRows& wanted, const PatchParts::Part& y,
                          const LaneTable<T>& table, double h_part, const std::vector<int>& places,
                          BlockSums<T>& to) {
  const bool with_h = h_part != 0;
  const SurfacePatch& p = y.patch;
  const std::size_t entry = 9 * to.lanes, nodes = p.nodes.size(), hats = p.hats.size();
  const SparseRows& rows = wanted.shapes;
  const Pairs close = close_pairs(pairs.quadrature(), x, p, KernelPart::dynamic_part),
              close_static = close_pairs(pairs.quadrature(), x, p, KernelPart::static_part);
  if (!close.empty()) {
    sum(pairs, x, p, close, table, with_h, to.lanes);
    add_scattered(places, y.hats, combined(rows, adjoint_, hats * entry, rows_), entry, 1, to.hats,
                  to.adjoint);
    add_combined_rows(rows, strain_.data(), 2 * entry, 1, places, to.strain.data());
    if (with_h) {
      combine_columns(p.displacements, x.shape_count, p.shape_count, inertia_, entry, by_node_);
      add_scattered(places, y.nodes, combined(rows, by_node_, nodes * entry, rows_), entry, h_part,
                    to.nodes, to.inertia);
    }
  }
  if (close_static.empty()) return;
  constexpr std::size_t kStatic = BlockSums<T>::kStaticEntry;
  sum_static(pairs, x, p, close_static, with_h);
  add_scattered(places, y.hats, combined(rows, static_g_, hats * kStatic, static_rows_), kStatic,
                -1, to.hats, to.static_g);
  if (!with_h) return;
  combine_columns(p.displacements, x.shape_count, p.shape_count, static_h_, kStatic,
                  static_by_node_);
  add_scattered(places, y.nodes, combined(rows, static_by_node_, nodes * kStatic, static_rows_),
                kStatic, h_part, to.nodes, to.static_h);
}

template class ClosePatches<float>;
template class ClosePatches<double>;

}  // namespace bem
