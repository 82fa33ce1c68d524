#include "compress/dense_store.hpp"

#include "base/parallel.hpp"
#include "compress/matrix_product.hpp"

#include <algorithm>

namespace bem {
namespace {

constexpr std::size_t kTile = 512;

std::size_t tiles(std::size_t n) {
  return (n + kTile - 1) / kTile;
}

Eigen::MatrixXd zeros(std::size_t rows, std::size_t columns) {
  return Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
}

}  // namespace

template <class T>
void DenseStore<T>::multiply_add(const double* x, double* y, int count) const {
  // a tile stays in the cache while all right-hand sides pass over it
  constexpr std::size_t kTileRows = 32, kTileColumns = 4096;
  parallel_for((rows_ + kTileRows - 1) / kTileRows, [&](std::size_t tile) {
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
void DenseStore<T>::multiply_transposed_add(const double* x, double* y, int count) const {
  // rows of this matrix are columns of the transposed one; a tile stays in the cache
  constexpr std::size_t kTileRows = 64;
  parallel_for(tiles(columns_), [&](std::size_t tile) {
    const std::size_t begin = tile * kTile, width = std::min(columns_, begin + kTile) - begin;
    std::vector<const T*> pointers;
    for (std::size_t first = 0; first < rows_; first += kTileRows) {
      pointers.clear();
      for (std::size_t i = first; i < std::min(rows_, first + kTileRows); ++i)
        pointers.push_back(row(i));
      for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c)
        add_columns(pointers.data(), pointers.size(), begin, width, x + c * rows_ + first,
                    y + c * columns_ + begin);
    }
  });
}

template <class T>
Eigen::MatrixXd DenseStore<T>::block(const std::vector<int>& rows,
                                     const std::vector<int>& columns) const {
  Eigen::MatrixXd out = zeros(rows.size(), columns.size());
  parallel_for(rows.size(), [&](std::size_t r) {
    for (std::size_t c = 0; c < columns.size(); ++c)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = row(rows[r])[columns[c]];
  });
  return out;
}

template <class T>
void ColumnStore<T>::multiply_add_columns(const std::vector<int>& columns, const double* x,
                                          double* y) const {
  std::vector<const T*> pointers;
  pointers.reserve(columns.size());
  for (int c : columns) pointers.push_back(column(static_cast<std::size_t>(c)));
  parallel_for(tiles(rows_), [&](std::size_t tile) {
    const std::size_t begin = tile * kTile;
    add_columns(pointers.data(), pointers.size(), begin, std::min(kTile, rows_ - begin), x,
                y + begin);
  });
}

template <class T>
void ColumnStore<T>::multiply_transposed_add(const double* x, double* y) const {
  parallel_for(columns_, [&](std::size_t j) {
    const T* entries = column(j);
    double sum = 0;
    for (std::size_t i = 0; i < rows_; ++i) sum += entries[i] * x[i];
    y[j] += sum;
  });
}

template <class T>
Eigen::MatrixXd ColumnStore<T>::block(const std::vector<int>& rows,
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
