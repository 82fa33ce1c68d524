#include "archive/scheme_tables.hpp"

namespace bem {

std::vector<SchemeTable> scheme_tables(const Scheme& scheme) {
  using Values = SchemeTable::Values;
  const Eigen::Index stages = scheme.stages();
  const auto& lag = scheme.lag_components();
  const auto& initial = scheme.initial_components();
  const auto lags = static_cast<Eigen::Index>(lag.size());
  const auto components = static_cast<Eigen::Index>(initial.size());
  Values left(lags, stages), right(lags, stages);
  for (Eigen::Index m = 0; m < lags; ++m) {
    left.row(m) = lag[m].left.transpose();
    right.row(m) = lag[m].right.transpose();
  }
  Values eigenvalues(components, 2), multiplicity(components, 1);
  Values initial_left(components, 2 * stages), initial_right(components, 2 * stages);
  for (Eigen::Index i = 0; i < components; ++i) {
    const InitialComponent& c = initial[i];
    eigenvalues.row(i) << c.eigenvalue.real(), c.eigenvalue.imag();
    multiplicity(i, 0) = c.multiplicity();
    initial_left.row(i) << c.left.transpose().real(), c.left.transpose().imag();
    initial_right.row(i) << c.right.transpose().real(), c.right.transpose().imag();
  }
  return {{"/scheme/stage_times", scheme.stage_times(), true, true},
          {"/scheme/lag_left", left, true},
          {"/scheme/lag_right", right, true},
          {"/scheme/initial_eigenvalues", eigenvalues, true},
          {"/scheme/initial_multiplicity", multiplicity, true},
          {"/scheme/initial_left", initial_left, false},
          {"/scheme/initial_right", initial_right, false}};
}

}  // namespace bem
