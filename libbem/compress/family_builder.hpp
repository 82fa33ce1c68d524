#pragma once

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

/// Makes a family from the rows of its matrices, which come in slabs, the first rows first. T: what
/// the entries are computed in. Bit-identical for any number of threads.
template <class T>
class FamilyBuilder {
 public:
  virtual ~FamilyBuilder() = default;
  /// The next rows of every matrix. Uses all worker threads.
  virtual void add_rows(const std::vector<MatrixView<T>>& matrices) = 0;
  virtual std::unique_ptr<MatrixFamily> finish() = 0;
  /// Frobenius norm of what the rows so far have lost, over all matrices, relative to theirs.
  virtual double error() const = 0;
};

}  // namespace bem
