#include "algebra/row_skeleton.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

RowSkeleton::RowSkeleton(const RealMatrix& a, double cut) {
  constexpr double kRounding = 1e-28;  // of the squares of the largest row
  constexpr double kCancelled = 1e-10;
  const Eigen::Index most = std::min(a.rows(), a.cols());
  Eigen::VectorXd left = a.rowwise().squaredNorm();
  coefficients.resize(a.rows(), 0);
  if (most == 0) return;
  const double rounding = kRounding * left.maxCoeff();
  double exact = left.sum();  // where differences of squares were last replaced by squares
  Eigen::MatrixXd directions(a.cols(), most);
  coefficients.resize(a.rows(), most);
  Eigen::Index rank = 0;
  for (; rank < most && left.sum() > cut; ++rank) {
    Eigen::Index pivot = 0;
    if (left.maxCoeff(&pivot) <= rounding) break;
    Eigen::VectorXd direction = a.row(pivot).transpose();
    const auto known = directions.leftCols(rank);
    for (int pass = 0; pass < 2; ++pass)
      direction -= known * (known.transpose() * direction).eval();
    directions.col(rank) = direction.normalized();
    auto column = coefficients.col(rank);
    column.noalias() = a * directions.col(rank);
    for (int row : rows) column[row] = 0;
    left = (left - column.cwiseAbs2()).cwiseMax(0.0);
    left[pivot] = 0;
    rows.push_back(static_cast<int>(pivot));
    if (left.sum() > kCancelled * exact) continue;
    left = (a - coefficients.leftCols(rank + 1) * directions.leftCols(rank + 1).transpose())
               .rowwise()
               .squaredNorm();
    for (int row : rows) left[row] = 0;
    exact = left.sum();
  }
  coefficients.conservativeResize(Eigen::NoChange, rank);
}

Eigen::MatrixXd RowSkeleton::in_skeleton(Eigen::MatrixXd combined) const {
  for (Eigen::Index k = size() - 1; k >= 0; --k) {
    for (Eigen::Index j = k + 1; j < size(); ++j)
      combined.col(k) -= coefficients(rows[j], k) * combined.col(j);
    combined.col(k) /= coefficients(rows[k], k);
  }
  return combined;
}

}  // namespace bem
