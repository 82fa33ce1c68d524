#pragma once

#include "compress/dense_store.hpp"
#include "compress/family_builder.hpp"
#include "compress/matrix_family.hpp"

namespace bem {

/// Codec "none": every entry of every matrix.
template <class T>
class DenseFamily : public MatrixFamily {
 public:
  /// `count` square matrices that are not initialised.
  DenseFamily(std::size_t size, int count);

  std::size_t rows() const override { return matrices_[0].rows(); }
  std::size_t columns() const override { return matrices_[0].columns(); }
  int count() const override { return static_cast<int>(matrices_.size()); }
  std::size_t bytes() const override { return matrices_.size() * matrices_[0].bytes(); }

  void multiply_add(const std::vector<FamilyTerm>& terms,
                    const std::vector<double*>& outputs) const override;
  void multiply_add(const std::vector<SparseTerm>& terms,
                    const std::vector<double*>& outputs) const override;
  void multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                               const std::vector<double*>& outputs) const override;
  std::unique_ptr<MatrixFamily> combine(
      const std::vector<std::vector<double>>& weights) const override;
  Eigen::MatrixXd block(int matrix, const std::vector<int>& rows,
                        const std::vector<int>& columns) const override {
    return matrices_[matrix].block(rows, columns);
  }
  std::unique_ptr<MatrixFamily> pick_columns(const std::vector<int>& columns) const override;
  void write(Hdf5File& file, const FamilyPlace& place, const BytesReport& report) const override;

  DenseStore<T>& matrix(int k) { return matrices_[k]; }
  const DenseStore<T>& matrix(int k) const { return matrices_[k]; }

 private:
  std::vector<DenseStore<T>> matrices_;
};

template <class T>
class DenseBuilder : public FamilyBuilder<T> {
 public:
  DenseBuilder(std::size_t size, int count)
      : family_(std::make_unique<DenseFamily<T>>(size, count)) {}

  void add_rows(const std::vector<MatrixView<T>>& matrices) override;
  std::unique_ptr<MatrixFamily> finish() override { return std::move(family_); }
  double error() const override { return 0; }

 private:
  std::unique_ptr<DenseFamily<T>> family_;
  std::size_t rows_ = 0;
};

/// Some columns of square matrices, uncompressed, for vectors that have entries there only.
template <class T>
class ColumnFamily : public MatrixFamily {
 public:
  /// `columns`: ascending.
  ColumnFamily(std::size_t size, std::vector<int> columns, int count);

  std::size_t rows() const override { return slots_.size(); }
  std::size_t columns() const override { return slots_.size(); }
  int count() const override { return static_cast<int>(matrices_.size()); }
  std::size_t bytes() const override { return matrices_.size() * matrices_[0].bytes(); }

  /// Entries in other columns count as zero.
  void multiply_add(const std::vector<FamilyTerm>& terms,
                    const std::vector<double*>& outputs) const override;
  void multiply_add(const std::vector<SparseTerm>& terms,
                    const std::vector<double*>& outputs) const override;
  void multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                               const std::vector<double*>& outputs) const override;
  std::unique_ptr<MatrixFamily> combine(
      const std::vector<std::vector<double>>& weights) const override;
  Eigen::MatrixXd block(int matrix, const std::vector<int>& rows,
                        const std::vector<int>& columns) const override;

  ColumnStore<T>& matrix(int k) { return matrices_[k]; }
  const std::vector<int>& stored_columns() const { return columns_; }

 private:
  std::vector<int> slots_of(const std::vector<int>& columns) const;

  std::vector<int> columns_;
  std::vector<int> slots_;  ///< by column: position in columns_, or -1
  std::vector<ColumnStore<T>> matrices_;
};

}  // namespace bem
