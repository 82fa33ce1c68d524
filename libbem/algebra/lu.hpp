#pragma once

#include "base/state_archive.hpp"

#include <vector>

namespace bem {

template <class T>
using DenseMatrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

/// LU factorisation with partial pivoting of a dense n x n matrix, everything in place: the matrix
/// is overwritten by its factors, and those by the inverse. Work is split into fixed tiles over the
/// worker threads; results are bit-identical for any number of threads. T: double, complex double.
template <class T>
class Lu {
 public:
  /// Factorises `a` in its own memory, n^3/3 multiply-adds (n x 128 elements of workspace).
  /// Throws ErrorCode::numerical if a pivot is zero or not finite.
  explicit Lu(DenseMatrix<T>&& a);
  Lu() = default;  ///< of nothing, to be restored

  void visit_state(StateArchive& state) {
    state.resizable(lu_, pivots_);
    state(norm1_);
    state.check(lu_.rows() == lu_.cols() && size() == static_cast<Eigen::Index>(pivots_.size()));
    for (int k = 0; k < static_cast<int>(pivots_.size()); ++k)
      state.check(pivots_[k] >= k && pivots_[k] < size());
  }

  /// b := a^{-1} b in place, n^2 multiply-adds per column.
  void solve(DenseMatrix<T>& b) const;

  /// The inverse, in the memory of the factors; 2/3 n^3 multiply-adds.
  DenseMatrix<T> invert() &&;

  /// Largest column sum of |a|, for a condition number.
  double norm1() const { return norm1_; }
  Eigen::Index size() const { return lu_.rows(); }

 private:
  void factor_panel(int first, int width, int rows_from);
  void update_trailing(int first, int width);
  void invert_upper();

  DenseMatrix<T> lu_;
  std::vector<int> pivots_;  ///< row k was exchanged with row pivots_[k]
  double norm1_ = 0;
};

/// Largest column sum of absolute values.
template <class T>
double norm1(const DenseMatrix<T>& a) {
  return a.cwiseAbs().colwise().sum().maxCoeff();
}

}  // namespace bem
