#include "assembly/shape_patches.hpp"

#include "assembly/lane_rows.hpp"

namespace bem {
namespace {

/// [shape of x][shape of y][size] -> [shape of x][node of y][size].
template <class T>
void combine_columns(const PatchPair& pair, const AlignedVector<T>& from, std::size_t size,
                     AlignedVector<T>& to) {
  const std::size_t row = pair.y.shape_count * size, row_of_to = pair.y.nodes.size() * size;
  to.resize(pair.x.shape_count * row_of_to);
  for (int x = 0; x < pair.x.shape_count; ++x)
    combine_rows(pair.y.displacements, &from[x * row], size, &to[x * row_of_to]);
}

}  // namespace

template <class T>
void ShapePatches<T>::sum(const PatchPair& pair, const LaneTable<T>& table, std::size_t lanes) {
  const SurfacePatch &x = pair.x, &y = pair.y;
  const PairIntegrals& integrals = pair.integrals;
  const std::size_t entry = 9 * lanes, hats = y.hats.size();
  if (pair.with_h()) set_zero(inertia_, x.shape_count * y.shape_count * entry);
  set_zero(adjoint_, x.shape_count * hats * entry);
  set_zero(strain_, x.shape_count * 2 * entry);
  const Vector6 pressure = integrals.pressure_of_strain();
  for (std::size_t k = 0; k < y.triangles.size(); ++k) {
    const Eigen::Matrix<double, 3, 6> tractions =
        integrals.shear_of_strain(integrals.quadrature().normal(y.triangles[k]));
    for (std::size_t i = 0; i < x.triangles.size(); ++i) {
      set_zero(uniform_, PairSums<T>::kUniform * kShapes * lanes);
      PairSums<T> sums = {};
      sums.lanes = lanes;
      for (int a = 0; a < kShapes; ++a) {
        const std::size_t shape = x.shapes[i][a];
        for (int b = 0; b < kShapes && pair.with_h(); ++b)
          sums.inertia[b][a] = &inertia_[(shape * y.shape_count + y.shapes[k][b]) * entry];
        for (int b = 0; b < 3; ++b)
          sums.adjoint[b][a] = &adjoint_[(shape * hats + y.shapes[k][b]) * entry];
        sums.uniform[a] = &uniform_[a * PairSums<T>::kUniform * lanes];
      }
      integrals.add(x.triangles[i], y.triangles[k], table, batch_, scratch_, sums);
      for (int a = 0; a < kShapes; ++a)
        add_strain(sums.uniform[a], lanes, tractions, pressure,
                   &strain_[x.shapes[i][a] * 2 * entry]);
    }
  }
}

template <class T>
void ShapePatches<T>::sum_static(const PatchPair& pair) {
  constexpr std::size_t kEntry = BlockSums<T>::kStaticEntry;
  const SurfacePatch &x = pair.x, &y = pair.y;
  const Material& m = pair.integrals.material();
  const std::size_t hats = y.hats.size();
  if (pair.with_h()) set_zero(static_h_, x.shape_count * y.shape_count * kEntry);
  set_zero(static_g_, x.shape_count * hats * kEntry);
  for (std::size_t i = 0; i < x.triangles.size(); ++i)
    for (std::size_t k = 0; k < y.triangles.size(); ++k) {
      PairMatrix form = PairMatrix::Zero();
      PairTractions tractions = PairTractions::Zero();
      add_static_pair(pair.integrals.quadrature(), m.shear_modulus, m.kappa(), x.triangles[i],
                      y.triangles[k], pair.with_h() ? &form : nullptr, tractions);
      for (int a = 0; a < kShapes; ++a)
        for (int e = 0; e < 9; ++e) {
          const int row = 3 * a + e / 3;
          const std::size_t shape = x.shapes[i][a];
          for (int b = 0; b < kShapes && pair.with_h(); ++b)
            static_h_[(shape * y.shape_count + y.shapes[k][b]) * kEntry + e] +=
                form(row, 3 * b + e % 3);
          for (int b = 0; b < 3; ++b)
            static_g_[(shape * hats + y.shapes[k][b]) * kEntry + e] +=
                tractions(row, 3 * b + e % 3);
        }
    }
}

template <class T>
void ShapePatches<T>::add_dynamic(const PatchPair& pair, const LaneTable<T>& table,
                                  const std::vector<int>& places, BlockSums<T>& to) {
  const SparseRows& rows = pair.rows.shapes;
  const std::size_t entry = 9 * to.lanes;
  sum(pair, table, to.lanes);
  add_combined_rows(rows, adjoint_.data(), to.hats * entry, 1, places, to.adjoint.data());
  add_combined_rows(rows, strain_.data(), 2 * entry, 1, places, to.strain.data());
  if (!pair.with_h()) return;
  combine_columns(pair, inertia_, entry, by_node_);
  add_combined_rows(rows, by_node_.data(), to.nodes * entry, pair.h_part, places,
                    to.inertia.data());
}

template <class T>
void ShapePatches<T>::add_static(const PatchPair& pair, const std::vector<int>& places,
                                 BlockSums<T>& to) {
  const SparseRows& rows = pair.rows.shapes;
  constexpr std::size_t kEntry = BlockSums<T>::kStaticEntry;
  sum_static(pair);
  add_combined_rows(rows, static_g_.data(), to.hats * kEntry, -1, places, to.static_g.data());
  if (!pair.with_h()) return;
  combine_columns(pair, static_h_, kEntry, static_by_node_);
  add_combined_rows(rows, static_by_node_.data(), to.nodes * kEntry, pair.h_part, places,
                    to.static_h.data());
}

template class ShapePatches<float>;
template class ShapePatches<double>;

}  // namespace bem
