#pragma once

#include "compress/codec.hpp"
#include "model/slab_assembly.hpp"

#include <functional>

namespace bem {

/// The dense matrices of lag 0 of one initial component while they are inverted: real, or complex
/// for a component that stands for a pair.
struct InitialMatrix {
  bool paired = false;
  MatrixForm form;
  DenseMatrix<double> real;
  DenseMatrix<Complex> complex;

  InitialMatrix(Eigen::Index n, bool is_paired, MatrixForm f) : paired(is_paired), form(f) {
    if (paired)
      complex.resize(n, n);
    else
      real.resize(n, n);
  }
  /// Stored columns of rows from row `first` on by their real and imaginary parts. Of a symmetric
  /// matrix the columns from `first` on are taken, and set their mirror images, too.
  void set_rows(Eigen::Index first, const ColumnPlaces& columns, const Eigen::MatrixXd& real_part,
                const Eigen::MatrixXd* imaginary_part);
  /// A block off the diagonal of a symmetric matrix, and its mirror image.
  void set_block(Eigen::Index row, Eigen::Index column, const Eigen::MatrixXd& real_part,
                 const Eigen::MatrixXd* imaginary_part);
  /// Adds the first matrix of a family to the real part.
  void add(const MatrixFamily& family);
};

/// Adds H_0^{-1} and, from the uncompressed G_0, H_0^{-1} G_0 of a component to the model, by a
/// codec that is not sampled; `g` may be null. Notes the condition number and the codec's errors.
/// In the inertial form both are without the rigid motions that forces cause.
void invert_dense(BodyModel& model, InitialMatrix&& h, InitialMatrix* g, const CodecOptions& codec,
                  const Progress& progress);

/// The same with a sampled codec, and with `g` compressed, too: H_0^{-1} is multiplied by it slab
/// by slab.
void invert_compressed(BodyModel& model, InitialMatrix&& h, const MatrixFamily* g,
                       const CodecOptions& codec, const Progress& progress);

}  // namespace bem
