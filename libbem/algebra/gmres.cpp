#include "algebra/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Jacobi>

namespace bem {
namespace {

/// The Krylov space of one right-hand side.
template <class T>
class Krylov {
 public:
  using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

  Krylov(const Vector& residual, double scale) : scale_(scale > 0 ? scale : 1) {
    const double norm = residual.norm();
    rhs_.push_back(norm);
    if (norm > 0) basis_.push_back(residual / norm);
  }

  double residual() const { return std::abs(rhs_.back()) / scale_; }
  bool is_open() const { return basis_.size() == rhs_.size(); }
  const Vector& next() const { return basis_.back(); }

  /// Takes the operator's value at next().
  void extend(Vector w) {
    constexpr double kCancelled = 0.1;
    const std::size_t j = columns_.size();
    Vector h = Vector::Zero(static_cast<Eigen::Index>(j + 2));
    double norm = w.norm(), before = 0;
    do {  // once more where much has cancelled
      before = norm;
      for (std::size_t i = 0; i <= j; ++i) {
        const T c = basis_[i].dot(w);
        h[static_cast<Eigen::Index>(i)] += c;
        w -= c * basis_[i];
      }
      norm = w.norm();
    } while (norm < kCancelled * before && norm > 0);
    h[static_cast<Eigen::Index>(j + 1)] = norm;
    for (std::size_t i = 0; i < j; ++i)
      h.applyOnTheLeft(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i + 1),
                       rotations_[i].adjoint());
    Eigen::JacobiRotation<T> rotation;
    T r;
    rotation.makeGivens(h[static_cast<Eigen::Index>(j)], h[static_cast<Eigen::Index>(j + 1)], &r);
    rotations_.push_back(rotation);
    h[static_cast<Eigen::Index>(j)] = r;
    columns_.push_back(h.head(static_cast<Eigen::Index>(j + 1)));
    Eigen::Matrix<T, 2, 1> pair(rhs_[j], T(0));
    pair.applyOnTheLeft(0, 1, rotation.adjoint());
    rhs_[j] = pair[0];
    rhs_.push_back(pair[1]);
    if (norm > std::numeric_limits<double>::min()) basis_.push_back(w / norm);
  }

  /// The correction that the space holds.
  void correction(Eigen::Ref<Vector> x) const {
    const auto n = static_cast<Eigen::Index>(columns_.size());
    Vector y(n);
    for (Eigen::Index i = n - 1; i >= 0; --i) {
      T sum = rhs_[i];
      for (Eigen::Index k = i + 1; k < n; ++k) sum -= columns_[k][i] * y[k];
      y[i] = sum / columns_[i][i];
    }
    x.setZero();
    for (Eigen::Index i = 0; i < n; ++i) x += y[i] * basis_[i];
  }

 private:
  double scale_;
  std::vector<Vector> basis_, columns_;  ///< orthonormal; the triangular matrix
  std::vector<Eigen::JacobiRotation<T>> rotations_;
  std::vector<T> rhs_;
};

}  // namespace

template <class T>
GmresResult gmres(const ColumnOperator<T>& apply, const ColumnsOf<T>& b, ColumnsOf<T>& x,
                  const GmresOptions& options, const ColumnOperator<T>& precondition) {
  ColumnsOf<T> rest = b;
  if (!x.isZero(0)) rest -= apply(x);
  std::vector<Krylov<T>> spaces;
  for (Eigen::Index c = 0; c < b.cols(); ++c) spaces.emplace_back(rest.col(c), b.col(c).norm());
  GmresResult result;
  std::vector<double> past;
  for (;; ++result.iterations) {
    std::vector<Eigen::Index> open;
    result.residual = 0;
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
      const Krylov<T>& space = spaces[c];
      result.residual = std::max(result.residual, space.residual());
      if (space.is_open() && space.residual() > options.tolerance) open.push_back(c);
    }
    past.push_back(result.residual);
    const bool stalled = result.iterations >= options.patience &&
                         result.residual > 0.5 * past[past.size() - 1 - options.patience];
    if (open.empty() || stalled || result.iterations >= options.most_iterations) break;
    ColumnsOf<T> inputs(b.rows(), static_cast<Eigen::Index>(open.size()));
    for (std::size_t i = 0; i < open.size(); ++i)
      inputs.col(static_cast<Eigen::Index>(i)) = spaces[open[i]].next();
    const ColumnsOf<T> outputs = apply(precondition ? precondition(inputs) : inputs);
    for (std::size_t i = 0; i < open.size(); ++i)
      spaces[open[i]].extend(outputs.col(static_cast<Eigen::Index>(i)));
  }
  ColumnsOf<T> corrections(b.rows(), b.cols());
  for (Eigen::Index c = 0; c < b.cols(); ++c) spaces[c].correction(corrections.col(c));
  x += precondition ? precondition(corrections) : corrections;
  return result;
}

template GmresResult gmres<double>(const ColumnOperator<double>&, const ColumnsOf<double>&,
                                   ColumnsOf<double>&, const GmresOptions&,
                                   const ColumnOperator<double>&);
template GmresResult gmres<Complex>(const ColumnOperator<Complex>&, const ColumnsOf<Complex>&,
                                    ColumnsOf<Complex>&, const GmresOptions&,
                                    const ColumnOperator<Complex>&);

}  // namespace bem
