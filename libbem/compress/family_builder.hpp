#pragma once

#include "algebra/factored_matrices.hpp"
#include "compress/block_partition.hpp"
#include "compress/matrix_family.hpp"

namespace bem {

/// Some rows of a matrix: column-major, rows apart by the outer stride.
template <class T>
using MatrixView =
    Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;

template <class T>
MatrixView<T> view(const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>& m) {
  return {m.data(), m.rows(), m.cols(), Eigen::OuterStride<>(m.rows())};
}

template <class T>
std::vector<MatrixView<T>> views(
    const std::vector<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>>& matrices) {
  std::vector<MatrixView<T>> out;
  for (const auto& m : matrices) out.push_back(view(m));
  return out;
}

/// A block of a family of matrices in factors: X_k = outputs * inputs[k].
struct FactoredBlock {
  NodeBlock nodes;
  const Eigen::MatrixXf* outputs;
  std::vector<const Eigen::MatrixXf*> inputs;
};

/// The rows of a slab, of which some columns are there, and the others in factors.
template <class T>
struct SlabParts {
  std::vector<MatrixView<T>> matrices;  ///< rows x columns that are there
  const std::vector<int>* places =
      nullptr;  ///< of columns by node, -1: in factors; null: all there
  std::vector<FactoredBlock> factored;

  Eigen::Index columns() const {
    return places ? static_cast<Eigen::Index>(3 * places->size()) : matrices.at(0).cols();
  }
};

/// Makes a family from the rows of its matrices, which come in slabs, the first rows first. T: what
/// the entries are computed in. Bit-identical for any number of threads.
template <class T>
class FamilyBuilder {
 public:
  virtual ~FamilyBuilder() = default;
  /// The next rows of every matrix. Uses all worker threads.
  virtual void add_rows(const std::vector<MatrixView<T>>& matrices) = 0;
  /// The same in parts, which are all of them there but for a codec that is sampled.
  virtual void add_parts(const SlabParts<T>& parts) { add_rows(parts.matrices); }
  virtual std::unique_ptr<MatrixFamily> finish() = 0;
  /// Frobenius norm of what the rows so far have lost, over all matrices, relative to theirs.
  virtual double error() const = 0;
};

}  // namespace bem
