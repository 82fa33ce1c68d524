#pragma once

#include "base/types.hpp"

#include <memory>
#include <vector>

namespace bem {

/// Every entry of a matrix, row-major, for products with whole vectors. All products use all worker
/// threads and are bit-identical for any number of them, and for a right-hand side alone or among
/// others.
template <class T>
class DenseStore {
 public:
  DenseStore(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), data_(new T[rows * columns]) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t bytes() const { return rows_ * columns_ * sizeof(T); }

  /// y_c += A x_c for `count` right-hand sides x + c*columns(), y + c*rows().
  void multiply_add(const double* x, double* y, int count) const;
  /// y += A(:, columns) x for an x with one entry per column.
  void multiply_add_columns(const std::vector<int>& columns, const double* x, double* y) const;
  /// y_c += A^T x_c for `count` right-hand sides x + c*rows(), y + c*columns().
  void multiply_transposed_add(const double* x, double* y, int count) const;
  /// Entries at the crossings of some rows and columns.
  Eigen::MatrixXd block(const std::vector<int>& rows, const std::vector<int>& columns) const;

  T* row(std::size_t i) { return data_.get() + i * columns_; }
  const T* row(std::size_t i) const { return data_.get() + i * columns_; }

 private:
  std::size_t rows_, columns_;
  std::unique_ptr<T[]> data_;  // not initialised: pages are touched by whoever fills them
};

/// Every entry, column-major, for products that need some columns only.
template <class T>
class ColumnStore {
 public:
  ColumnStore(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), data_(new T[rows * columns]) {}

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t bytes() const { return rows_ * columns_ * sizeof(T); }

  void multiply_add_columns(const std::vector<int>& columns, const double* x, double* y) const;
  void multiply_transposed_add(const double* x, double* y) const;
  Eigen::MatrixXd block(const std::vector<int>& rows, const std::vector<int>& columns) const;

  T* column(std::size_t j) { return data_.get() + j * rows_; }
  const T* column(std::size_t j) const { return data_.get() + j * rows_; }

 private:
  std::size_t rows_, columns_;
  std::unique_ptr<T[]> data_;
};

}  // namespace bem
