#pragma once

#include "base/types.hpp"

#include <memory>
#include <vector>

namespace bem {

/// Number format of uncompressed matrix entries.
enum class Precision { float32, float64 };

inline std::size_t bytes_per_entry(Precision p) {
  return p == Precision::float32 ? 4 : 8;
}

/// One product of a sum: outputs[output] += matrix * input.
struct FamilyTerm {
  int matrix = 0;
  const double* input = nullptr;
  int output = 0;
};

/// A product with a vector that has few entries, [column] -> value.
struct SparseTerm {
  int matrix = 0;
  const std::vector<int>* columns = nullptr;  ///< ascending
  const double* values = nullptr;
  int output = 0;
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

  /// A vector is analysed once, and what comes of it is multiplied as often as needed (a
  /// displacement by the matrix of another lag in every step). Linear. `analysed` has
  /// analysed_size() entries.
  virtual std::size_t analysed_size() const = 0;
  virtual void analyse(const double* x, double* analysed) const = 0;

  /// For all terms, whose inputs are analysed: outputs[t.output] += A_{t.matrix} t.input.
  virtual void multiply_add(const std::vector<FamilyTerm>& terms,
                            const std::vector<double*>& outputs) const = 0;
  /// The same for vectors with few entries; parts of the matrices that meet none are not read.
  virtual void multiply_add(const std::vector<SparseTerm>& terms,
                            const std::vector<double*>& outputs) const = 0;
  /// For all terms, whose inputs are plain: outputs[t.output] += A_{t.matrix}^T t.input.
  virtual void multiply_transposed_add(const std::vector<FamilyTerm>& terms,
                                       const std::vector<double*>& outputs) const = 0;

  /// Entries at the crossings of some rows and columns.
  virtual Eigen::MatrixXd block(int matrix, const std::vector<int>& rows,
                                const std::vector<int>& columns) const = 0;
};

}  // namespace bem
