#pragma once

#include "algebra/matrix_form.hpp"
#include "base/aligned.hpp"
#include "compress/layered_matrix.hpp"
#include "compress/matrix_family.hpp"

#include <cstdint>

namespace bem {

/// One block of a LowRankFamily. Columns [column_begin, column_end) of an input are brought to the
/// input basis (analysis), the coupling of every matrix takes them to the output basis, and that to
/// rows [row_begin, row_end). Where bases would not pay, `plain`, the couplings are the block's
/// entries themselves.
struct LowRankBlock {
  int row_begin = 0, row_end = 0, column_begin = 0, column_end = 0;  ///< unknowns
  bool plain = false;
  Layers input_basis;   ///< rank x columns; rows in units of their scales
  Layers output_basis;  ///< rows x rank; columns in units of their scales

  int rows() const { return row_end - row_begin; }
  int columns() const { return column_end - column_begin; }
  bool is_right_of_diagonal() const { return column_begin >= row_end; }
  int input_rank() const { return plain ? columns() : input_basis.stored_rows(); }
  int output_rank() const { return plain ? rows() : output_basis.stored_columns(); }
};

/// The blocks in a range of rows, and their numbers.
struct LowRankSlab {
  int row_begin = 0, row_end = 0;  ///< unknowns
  std::vector<LowRankBlock> blocks;
  std::vector<Layers> couplings;        ///< [block][matrix], output rank x input rank
  std::vector<float> input_scales;      ///< of the blocks' input bases, one after another
  std::vector<float> output_scales;     ///< of their output bases
  std::vector<std::uint8_t> analysis;   ///< input bases
  std::vector<std::uint8_t> synthesis;  ///< couplings of a block, then its output basis
};

/// Codec "lowrank": blocks with bases that are common to all matrices of the family, and numbers of
/// 8, 16 or 32 bits, as many as what they carry needs. A symmetric family stores the blocks on the
/// diagonal and those to the right of them, which stand for their mirror images, too.
class LowRankFamily : public MatrixFamily {
 public:
  /// `quantum`: unit of the entries of couplings, the same for the whole family.
  LowRankFamily(std::size_t size, int count, double quantum, std::vector<LowRankSlab> slabs,
                MatrixForm form);

  std::size_t rows() const override { return size_; }
  std::size_t columns() const override { return size_; }
  int count() const override { return count_; }
  std::size_t bytes() const override;

  /// Coefficients in the blocks' input bases, of mirror images in their output bases, block by
  /// block.
  std::size_t coefficients() const override { return coefficients_; }
  void analyse(const double* x, float* coefficients) const override {
    analyse_columns(x, 1, coefficients);
  }
  void analyse_columns(const Eigen::MatrixXd& x, Eigen::MatrixXf& coefficients) const override {
    analyse_columns(x.data(), x.cols(), coefficients.data());
  }
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

  /// Of a general family.
  FloatMatrix multiply_left(const FloatMatrix& x, int matrix) const override;
  void write(Hdf5File& file, const FamilyPlace& place, const BytesReport& report) const override;
  double table_bytes() const override;
  /// Of the tables of a block, and of its coupling in a matrix.
  static constexpr double kBlockBytes = 68, kCouplingBytes = 24;

  double quantum() const { return quantum_; }
  MatrixForm form() const { return form_; }
  const std::vector<LowRankSlab>& slabs() const { return slabs_; }

 private:
  /// Where the numbers of a block are in its slab, and its coefficients in an analysed vector.
  struct Place {
    std::size_t analysis = 0, input_scales = 0, output_scales = 0, output_basis = 0;
    std::size_t coefficients = 0, mirrored_coefficients = 0;
    std::vector<std::size_t> couplings;  ///< by matrix
  };
  class SlabProduct;
  bool is_mirrored(const LowRankBlock& block) const {
    return form_ == MatrixForm::symmetric && block.is_right_of_diagonal();
  }
  /// Calls add(product, slab, block) for all blocks, between begin() and end() of each, and adds
  /// the products to the outputs.
  template <class F>
  void multiply_blocks(const std::vector<double*>& outputs, const F& add) const;
  void analyse_columns(const double* x, Eigen::Index count, float* coefficients) const;

  /// Parts of a block as matrices: X = Q C P with all scales in C, or X = C if it is plain.
  FloatMatrix coupling(std::size_t slab, std::size_t block, int matrix) const;
  FloatMatrix output_basis(std::size_t slab, std::size_t block) const;
  FloatMatrix input_basis(std::size_t slab, std::size_t block) const;

  std::size_t size_;
  int count_;
  double quantum_;
  MatrixForm form_;
  std::vector<LowRankSlab> slabs_;
  std::vector<std::vector<Place>> places_;  ///< [slab][block]
  std::size_t coefficients_ = 0;
};

}  // namespace bem
