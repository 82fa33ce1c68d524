#pragma once

#include "compress/haar_transform.hpp"
#include "compress/matrix_family.hpp"
#include "compress/packed_rows.hpp"

namespace bem {

/// Codec "haar": of every matrix A, whose 9 parts for two axes each are transformed by themselves,
/// A_ab = W^T C_ab W with the orthonormal W of haar_steps(), the largest coefficients C (wavelet
/// compression as in section 3.3 of the paper). Row and column axis * n + i of C belong to
/// coefficient i of n nodes, whose order is that of recursive bisection.
class HaarFamily : public MatrixFamily {
 public:
  /// `coefficients`: the rows of C of the first matrix, then those of the next.
  HaarFamily(std::size_t size, int count, PackedRows coefficients);

  std::size_t rows() const override { return size_; }
  std::size_t columns() const override { return size_; }
  int count() const override { return count_; }
  std::size_t bytes() const override { return rows_.bytes(); }

  /// The transformed vector.
  std::size_t coefficients() const override { return size_; }
  void analyse(const double* x, float* coefficients) const override;
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

  void write(Hdf5File& file, const FamilyPlace& place, const BytesReport& report) const override;

  /// Without the coefficients that vectors with entries in some columns (ascending) do not meet.
  std::unique_ptr<HaarFamily> restrict_to(const std::vector<int>& columns) const;

  const PackedRows& packed() const { return rows_; }

 private:
  /// Adds what the coefficients stand for to a vector.
  void synthesise_to(Eigen::VectorXd& coefficients, double* y) const;
  /// The family with other rows, which `make` appends to its last argument one by one.
  template <class F>
  PackedRows make_rows(std::size_t count, PackedRows empty, const F& make) const;

  std::size_t size_;
  int count_;
  std::vector<HaarStep> steps_;
  PackedRows rows_;
};

}  // namespace bem
