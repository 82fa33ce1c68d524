#include "dynamics/displacement_rate.hpp"

#include <algorithm>

namespace bem {

DisplacementRate::DisplacementRate(const Scheme& scheme, double dt, Eigen::Index unknowns) {
  for (const StageMatrix& delta : scheme.delta_coefficients()) {
    weights_.emplace_back(delta.row(delta.rows() - 1).transpose() / dt);
    past_.push_back(Eigen::MatrixXd::Zero(unknowns, scheme.stages()));
  }
}

void DisplacementRate::push(const Eigen::MatrixXd& stages) {
  std::rotate(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = stages;
}

Eigen::VectorXd DisplacementRate::value() const {
  Eigen::VectorXd sum = past_[0] * weights_[0];
  for (std::size_t m = 1; m < past_.size(); ++m) sum.noalias() += past_[m] * weights_[m];
  return sum;
}

}  // namespace bem
