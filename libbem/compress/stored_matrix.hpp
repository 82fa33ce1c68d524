#pragma once

#include "base/types.hpp"

#include <memory>
#include <vector>

namespace bem {

/// Number format of stored matrix entries.
enum class Precision { float32, float64 };

inline std::size_t bytes_per_entry(Precision p) {
  return p == Precision::float32 ? 4 : 8;
}

/// A real matrix as it is kept in memory and in archives; the codecs of an archive implement this.
class StoredMatrix {
 public:
  virtual ~StoredMatrix() = default;

  virtual std::size_t rows() const = 0;
  virtual std::size_t columns() const = 0;
  /// Bytes that one product reads.
  virtual std::size_t bytes() const = 0;

  /// y_c += A x_c for `count` right-hand sides x + c*columns(), y + c*rows(). Uses all worker
  /// threads; bit-identical for any number of them, and for a right-hand side alone or among
  /// others.
  virtual void multiply_add(const double* x, double* y, int count) const = 0;

  /// y += A(:, columns) x for an x with one entry per column. Reads these columns alone. Uses all
  /// worker threads; bit-identical for any number of them.
  virtual void multiply_add_columns(const std::vector<int>& columns, const double* x,
                                    double* y) const = 0;

  /// Entries of some columns, rows() x columns.size().
  virtual Eigen::MatrixXd extract_columns(const std::vector<int>& columns) const = 0;
  /// Entries at the crossings of some rows and columns, rows.size() x columns.size().
  virtual Eigen::MatrixXd extract_block(const std::vector<int>& rows,
                                        const std::vector<int>& columns) const = 0;
};

/// Codec "none": every entry, row-major; for matrices that are multiplied by whole vectors.
template <class T>
class DenseStore : public StoredMatrix {
 public:
  DenseStore(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), data_(new T[rows * columns]) {}

  std::size_t rows() const override { return rows_; }
  std::size_t columns() const override { return columns_; }
  std::size_t bytes() const override { return rows_ * columns_ * sizeof(T); }
  void multiply_add(const double* x, double* y, int count) const override;
  void multiply_add_columns(const std::vector<int>& columns, const double* x,
                            double* y) const override;
  Eigen::MatrixXd extract_columns(const std::vector<int>& columns) const override;
  Eigen::MatrixXd extract_block(const std::vector<int>& rows,
                                const std::vector<int>& columns) const override;

  T* row(std::size_t i) { return data_.get() + i * columns_; }
  const T* row(std::size_t i) const { return data_.get() + i * columns_; }

 private:
  std::size_t rows_, columns_;
  std::unique_ptr<T[]> data_;  // not initialised: pages are touched by whoever fills them
};

/// Every entry, column-major; for matrices of which a product needs some columns only.
template <class T>
class ColumnStore : public StoredMatrix {
 public:
  ColumnStore(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), data_(new T[rows * columns]) {}

  std::size_t rows() const override { return rows_; }
  std::size_t columns() const override { return columns_; }
  std::size_t bytes() const override { return rows_ * columns_ * sizeof(T); }
  void multiply_add(const double* x, double* y, int count) const override;
  void multiply_add_columns(const std::vector<int>& columns, const double* x,
                            double* y) const override;
  Eigen::MatrixXd extract_columns(const std::vector<int>& columns) const override;
  Eigen::MatrixXd extract_block(const std::vector<int>& rows,
                                const std::vector<int>& columns) const override;

  T* column(std::size_t j) { return data_.get() + j * rows_; }
  const T* column(std::size_t j) const { return data_.get() + j * rows_; }

 private:
  std::size_t rows_, columns_;
  std::unique_ptr<T[]> data_;
};

}  // namespace bem
