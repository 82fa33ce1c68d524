#pragma once

#include "base/types.hpp"
#include "compress/family_storage.hpp"

#include <memory>
#include <vector>

namespace bem {

/// One product of a sum: outputs[output] += factor * matrix * input.
struct FamilyTerm {
  int matrix = 0;
  const double* input = nullptr;
  const float* coefficients = nullptr;  ///< of the input, from MatrixFamily::analyse
  int output = 0;
  double factor = 1;
};

/// The same for a vector with few entries.
struct SparseTerm {
  int matrix = 0;
  const std::vector<int>* columns = nullptr;  ///< of the entries, ascending
  const double* values = nullptr;
  int output = 0;
  double factor = 1;
};

/// Real matrices of the same size that belong together (all lags and components of H, or the real
/// and imaginary part of H_0^{-1}) as a codec stores them. Every product uses all worker threads,
/// reads the values that it needs once, and is bit-identical for any number of threads.
class MatrixFamily {
 public:
  virtual ~MatrixFamily() = default;

  virtual std::size_t rows() const = 0;
  virtual std::size_t columns() const = 0;
  virtual int count() const = 0;
  /// Of the stored values: what a product with every matrix reads.
  virtual std::size_t bytes() const = 0;

  /// A vector is analysed once and multiplied as often as needed (a displacement by the matrix of
  /// another lag in every step): what a codec wants to know of it besides its entries. Linear.
  virtual std::size_t coefficients() const { return 0; }
  virtual void analyse(const double* /*x*/, float* /*coefficients*/) const {}
  /// The same for the columns of x, whose coefficients are columns, too; reads what it needs once.
  virtual void analyse_columns(const Eigen::MatrixXd& x, Eigen::MatrixXf& coefficients) const {
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      analyse(x.col(c).data(), coefficients.col(c).data());
  }

  /// outputs[t.output] += t.factor A_{t.matrix} t.input for all terms.
  virtual void multiply_add(const std::vector<FamilyTerm>& terms,
                            const std::vector<double*>& outputs) const = 0;
  /// The same for vectors with few entries; parts of the matrices that meet none are not read.
  virtual void multiply_add(const std::vector<SparseTerm>& terms,
                            const std::vector<double*>& outputs) const = 0;
  /// outputs[t.output] += t.factor A_{t.matrix}^T t.input for all terms; no coefficients.
  virtual void multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                                       const std::vector<double*>& outputs) const = 0;

  /// The family of the sums B_j = sum_k weights[j][k] A_k.
  virtual std::unique_ptr<MatrixFamily> combine(
      const std::vector<std::vector<double>>& weights) const = 0;

  /// Entries at the crossings of some rows and columns.
  virtual Eigen::MatrixXd block(int matrix, const std::vector<int>& rows,
                                const std::vector<int>& columns) const = 0;
  /// X A_matrix for many rows at once, in single precision: p x size.
  virtual Eigen::MatrixXf multiply_left(const Eigen::MatrixXf& x, int matrix) const;
  /// A smaller family for vectors with entries in some columns (ascending) only; null if parts that
  /// they do not meet are not worth a copy of the others.
  virtual std::unique_ptr<MatrixFamily> pick_columns(const std::vector<int>& /*columns*/) const {
    return nullptr;
  }

  /// Writes it to an archive, where its codec reads it. Not of families of some columns.
  virtual void write(Hdf5File& file, const FamilyPlace& place, const BytesReport& report) const;
  /// Of tables that write() stores besides the values.
  virtual double table_bytes() const { return 0; }
};

/// Terms in the order of their matrices.
template <class Term>
std::vector<Term> sorted_by_matrix(std::vector<Term> terms);

/// A whole matrix, for tests and comparisons.
Eigen::MatrixXd full_matrix(const MatrixFamily& family, int matrix);

}  // namespace bem
