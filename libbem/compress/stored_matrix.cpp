#include "compress/stored_matrix.hpp"

#include "base/parallel.hpp"
#include "compress/matrix_product.hpp"

#include <algorithm>

namespace bem {

template <class T>
void DenseStore<T>::multiply_add(const double* x, double* y, int count) const {
  constexpr std::size_t kTileRows = 96;
  const std::size_t tiles = (rows_ + kTileRows - 1) / kTileRows;
  for (int first = 0; first < count; first += kMaxRightHandSides) {
    const int group = std::min(kMaxRightHandSides, count - first);
    parallel_for(tiles, [&](std::size_t tile) {
      const std::size_t begin = tile * kTileRows;
      multiply_rows(row(begin), std::min(kTileRows, rows_ - begin), columns_, x + first * columns_,
                    columns_, y + first * rows_ + begin, rows_, group);
    });
  }
}

template <class T>
Eigen::MatrixXd DenseStore<T>::extract_columns(const std::vector<int>& column_indices) const {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(rows_),
                      static_cast<Eigen::Index>(column_indices.size()));
  parallel_for(rows_, [&](std::size_t i) {
    for (std::size_t c = 0; c < column_indices.size(); ++c)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = row(i)[column_indices[c]];
  });
  return out;
}

template class DenseStore<float>;
template class DenseStore<double>;

}  // namespace bem
