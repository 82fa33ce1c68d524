#include "algebra/lu.hpp"

#include "algebra/blas.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr int kPanel = 128;  // columns factorised at a time
constexpr int kTile = 256;   // rows or columns of one task
constexpr int kLeaf = 16;    // columns of the unblocked factorisation

int tiles(int n) {
  return (n + kTile - 1) / kTile;
}

}  // namespace

template <class T>
Lu<T>::Lu(DenseMatrix<T>&& a) : lu_(std::move(a)) {
  require(lu_.rows() == lu_.cols(), "the matrix is square");
  const int n = static_cast<int>(lu_.rows());
  norm1_ = bem::norm1(lu_);
  pivots_.resize(n);
  for (int first = 0; first < n; first += kPanel) {
    const int width = std::min(kPanel, n - first);
    factor_panel(first, width, first);
    update_trailing(first, width);
  }
}

/// Factorises columns [first, first+width) from row `rows_from` on, by recursive halving.
template <class T>
void Lu<T>::factor_panel(int first, int width, int rows_from) {
  const int n = static_cast<int>(lu_.rows());
  const int ld = n;
  if (width > kLeaf) {
    const int left = width / 2, right = width - left, middle = first + left;
    factor_panel(first, left, rows_from);
    for (int k = first; k < middle; ++k)
      if (pivots_[k] != k)
        lu_.row(k).segment(middle, right).swap(lu_.row(pivots_[k]).segment(middle, right));
    T* top = &lu_(first, middle);
    trsm(Side::left, TriangleShape::lower_unit, left, right, &lu_(first, first), ld, top, ld);
    gemm(n - middle, right, left, T(-1), &lu_(middle, first), ld, top, ld, &lu_(middle, middle),
         ld);
    factor_panel(middle, right, middle);
    for (int k = middle; k < middle + right; ++k)
      if (pivots_[k] != k)
        lu_.row(k).segment(first, left).swap(lu_.row(pivots_[k]).segment(first, left));
    return;
  }
  for (int k = first; k < first + width; ++k) {
    int best = k;
    double largest = std::abs(lu_(k, k));
    for (int i = k + 1; i < n; ++i) {
      const double value = std::abs(lu_(i, k));
      if (value > largest) {
        largest = value;
        best = i;
      }
    }
    pivots_[k] = best;
    if (!(largest > 0) || !std::isfinite(largest))
      throw Error(ErrorCode::numerical,
                  "the system matrix is singular at column " + std::to_string(k));
    if (best != k) lu_.row(k).segment(first, width).swap(lu_.row(best).segment(first, width));
    const T inverse = T(1) / lu_(k, k);
    lu_.col(k).tail(n - k - 1) *= inverse;
    for (int j = k + 1; j < first + width; ++j)
      lu_.col(j).tail(n - k - 1) -= lu_(k, j) * lu_.col(k).tail(n - k - 1);
  }
}

/// Row exchanges on all other columns and the update of the columns to the right, tile by tile.
template <class T>
void Lu<T>::update_trailing(int first, int width) {
  const int n = static_cast<int>(lu_.rows());
  const int next = first + width;
  const int left_tiles = tiles(first), right_tiles = tiles(n - next);
  parallel_for(left_tiles + right_tiles, [&](std::size_t task) {
    const bool left = static_cast<int>(task) < left_tiles;
    const int begin = left ? static_cast<int>(task) * kTile
                           : next + (static_cast<int>(task) - left_tiles) * kTile;
    const int columns = std::min(kTile, (left ? first : n) - begin);
    for (int j = begin; j < begin + columns; ++j)
      for (int k = first; k < next; ++k)
        if (pivots_[k] != k) std::swap(lu_(k, j), lu_(pivots_[k], j));
    if (left) return;
    trsm(Side::left, TriangleShape::lower_unit, width, columns, &lu_(first, first), n,
         &lu_(first, begin), n);
    if (next < n)
      gemm(n - next, columns, width, T(-1), &lu_(next, first), n, &lu_(first, begin), n,
           &lu_(next, begin), n);
  });
}

template <class T>
void Lu<T>::solve(DenseMatrix<T>& b) const {
  const int n = static_cast<int>(lu_.rows());
  require(b.rows() == n, "the right-hand side has as many rows as the matrix");
  const int count = static_cast<int>(b.cols());
  if (count == 1) {  // BLAS would pack the factors for one column
    for (int k = 0; k < n; ++k)
      if (pivots_[k] != k) std::swap(b(k, 0), b(pivots_[k], 0));
    lu_.template triangularView<Eigen::UnitLower>().solveInPlace(b.col(0));
    lu_.template triangularView<Eigen::Upper>().solveInPlace(b.col(0));
    return;
  }
  parallel_for(tiles(count), [&](std::size_t task) {
    const int begin = static_cast<int>(task) * kTile;
    const int columns = std::min(kTile, count - begin);
    for (int j = begin; j < begin + columns; ++j)
      for (int k = 0; k < n; ++k)
        if (pivots_[k] != k) std::swap(b(k, j), b(pivots_[k], j));
    T* tile = &b(0, begin);
    trsm(Side::left, TriangleShape::lower_unit, n, columns, lu_.data(), n, tile, n);
    trsm(Side::left, TriangleShape::upper, n, columns, lu_.data(), n, tile, n);
  });
}

/// U := U^{-1} in place, block column by block column from the left.
template <class T>
void Lu<T>::invert_upper() {
  const int n = static_cast<int>(lu_.rows());
  DenseMatrix<T> column(n, kPanel);
  for (int first = 0; first < n; first += kPanel) {
    const int width = std::min(kPanel, n - first);
    // the diagonal block: its inverse, by solving for the identity
    DenseMatrix<T> diagonal = DenseMatrix<T>::Identity(width, width);
    trsm(Side::left, TriangleShape::upper, width, width, &lu_(first, first), n, diagonal.data(),
         width);
    // above: -(U^{-1})_{above} U_{above, block} diagonal
    column.topLeftCorner(first, width) = lu_.block(0, first, first, width);
    parallel_for(tiles(first), [&](std::size_t task) {
      const int begin = static_cast<int>(task) * kTile;
      const int rows = std::min(kTile, first - begin);
      DenseMatrix<T> product = column.block(begin, 0, rows, width);
      trmm_upper(rows, width, &lu_(begin, begin), n, product.data(), rows);
      const int rest = first - begin - rows;
      if (rest > 0)
        gemm(rows, width, rest, T(1), &lu_(begin, begin + rows), n, &column(begin + rows, 0), n,
             product.data(), rows);
      auto target = lu_.block(begin, first, rows, width);
      target.setZero();
      gemm(rows, width, width, T(-1), product.data(), rows, diagonal.data(), width,
           &lu_(begin, first), n);
    });
    lu_.block(first, first, width, width).template triangularView<Eigen::Upper>() = diagonal;
  }
}

template <class T>
DenseMatrix<T> Lu<T>::invert() && {
  const int n = static_cast<int>(lu_.rows());
  invert_upper();
  // A^{-1} = U^{-1} L^{-1} P: block columns of L from the right, X_j = (X_j - X_{>j} L_{>j,j})
  // L_jj^{-1}
  DenseMatrix<T> lower(n, kPanel);
  for (int first = (n - 1) / kPanel * kPanel; first >= 0; first -= kPanel) {
    const int width = std::min(kPanel, n - first);
    for (int j = 0; j < width; ++j)
      for (int i = first + j + 1; i < n; ++i) {
        lower(i, j) = lu_(i, first + j);
        lu_(i, first + j) = T(0);
      }
    const int next = first + width;
    parallel_for(tiles(n), [&](std::size_t task) {
      const int begin = static_cast<int>(task) * kTile;
      const int rows = std::min(kTile, n - begin);
      if (next < n)
        gemm(rows, width, n - next, T(-1), &lu_(begin, next), n, &lower(next, 0), n,
             &lu_(begin, first), n);
      trsm(Side::right, TriangleShape::lower_unit, rows, width, &lower(first, 0), n,
           &lu_(begin, first), n);
    });
  }
  for (int k = n - 1; k >= 0; --k)
    if (pivots_[k] != k) lu_.col(k).swap(lu_.col(pivots_[k]));
  return std::move(lu_);
}

template class Lu<double>;
template class Lu<Complex>;

}  // namespace bem
