#include "compress/stored_matrix.hpp"

#include "base/parallel.hpp"
#include "compress/matrix_product.hpp"

#include <algorithm>
#include <numeric>

namespace bem {
namespace {

Eigen::MatrixXd zeros(std::size_t rows, std::size_t columns) {
  return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
}

}  // namespace

template <class T>
void DenseStore<T>::multiply_add(const double* x, double* y, int count) const {
  // a tile stays in the cache while all right-hand sides pass over it
  constexpr std::size_t kTileRows = 32, kTileColumns = 4096;
  const std::size_t tiles = (rows_ + kTileRows - 1) / kTileRows;
  parallel_for(tiles, [&](std::size_t tile) {
    const std::size_t begin = tile * kTileRows, rows = std::min(kTileRows, rows_ - begin);
    for (std::size_t column = 0; column < columns_; column += kTileColumns) {
      const std::size_t columns = std::min(kTileColumns, columns_ - column);
      for (int first = 0; first < count; first += kMaxRightHandSides)
        multiply_rows(row(begin) + column, rows, columns, columns_, x + first * columns_ + column,
                      columns_, y + first * rows_ + begin, rows_,
                      std::min(kMaxRightHandSides, count - first));
    }
  });
}

template <class T>
void DenseStore<T>::multiply_add_columns(const std::vector<int>& columns, const double* x,
                                         double* y) const {
  parallel_for(rows_, [&](std::size_t i) {
    const T* entries = row(i);
    double sum = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) sum += entries[columns[c]] * x[c];
    y[i] += sum;
  });
}

template <class T>
Eigen::MatrixXd DenseStore<T>::extract_columns(const std::vector<int>& columns) const {
  Eigen::MatrixXd out = zeros(rows_, columns.size());
  parallel_for(rows_, [&](std::size_t i) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = row(i)[columns[c]];
  });
  return out;
}

template <class T>
Eigen::MatrixXd DenseStore<T>::extract_block(const std::vector<int>& rows,
                                             const std::vector<int>& columns) const {
  Eigen::MatrixXd out = zeros(rows.size(), columns.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = row(rows[r])[columns[c]];
  return out;
}

template <class T>
void ColumnStore<T>::multiply_add(const double* x, double* y, int count) const {
  std::vector<int> all(columns_);
  std::iota(all.begin(), all.end(), 0);
  for (int c = 0; c < count; ++c)
    multiply_add_columns(all, x + static_cast<std::size_t>(c) * columns_,
                         y + static_cast<std::size_t>(c) * rows_);
}

template <class T>
void ColumnStore<T>::multiply_add_columns(const std::vector<int>& columns, const double* x,
                                          double* y) const {
  constexpr std::size_t kTileRows = 512;
  std::vector<const T*> pointers;
  pointers.reserve(columns.size());
  for (int c : columns) pointers.push_back(column(static_cast<std::size_t>(c)));
  parallel_for((rows_ + kTileRows - 1) / kTileRows, [&](std::size_t tile) {
    const std::size_t begin = tile * kTileRows;
    add_columns(pointers.data(), pointers.size(), begin, std::min(kTileRows, rows_ - begin), x,
                y + begin);
  });
}

template <class T>
Eigen::MatrixXd ColumnStore<T>::extract_columns(const std::vector<int>& columns) const {
  Eigen::MatrixXd out = zeros(rows_, columns.size());
  parallel_for(columns.size(), [&](std::size_t c) {
    std::copy_n(column(static_cast<std::size_t>(columns[c])), rows_,
                out.col(static_cast<Eigen::Index>(c)).data());
  });
  return out;
}

template <class T>
Eigen::MatrixXd ColumnStore<T>::extract_block(const std::vector<int>& rows,
                                              const std::vector<int>& columns) const {
  Eigen::MatrixXd out = zeros(rows.size(), columns.size());
  parallel_for(columns.size(), [&](std::size_t c) {
    const T* from = column(static_cast<std::size_t>(columns[c]));
    double* to = out.col(static_cast<Eigen::Index>(c)).data();
    for (std::size_t r = 0; r < rows.size(); ++r) to[r] = from[rows[r]];
  });
  return out;
}

template class DenseStore<float>;
template class DenseStore<double>;
template class ColumnStore<float>;
template class ColumnStore<double>;

}  // namespace bem
