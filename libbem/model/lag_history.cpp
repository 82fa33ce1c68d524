#include "model/lag_history.hpp"

#include <algorithm>

namespace bem {

Eigen::MatrixXd lag_inputs(const Scheme& scheme) {
  const auto& components = scheme.lag_components();
  Eigen::MatrixXd right(scheme.stages(), static_cast<Eigen::Index>(components.size()));
  for (Eigen::Index m = 0; m < right.cols(); ++m) right.col(m) = components[m].right;
  return right;
}

LagHistory::LagHistory(const Scheme& scheme, Eigen::Index inputs, int history_length, double window,
                       const MatrixFamily* family)
    : right_(lag_inputs(scheme)),
      window_(window),
      family_(family),
      ring_(history_length, Eigen::MatrixXd::Zero(inputs, right_.cols())),
      coefficients_(
          history_length,
          Eigen::MatrixXf::Zero(family ? static_cast<Eigen::Index>(family->coefficients()) : 0,
                                right_.cols())),
      zero_(history_length, 1) {}

void LagHistory::push(const Eigen::MatrixXd& stages) {
  if (ring_.empty()) return;
  newest_ = (newest_ + ring_.size() - 1) % ring_.size();
  ring_[newest_].noalias() = stages * right_;
  zero_[newest_] = stages.isZero(0);
  if (family_) family_->analyse_columns(ring_[newest_], coefficients_[newest_]);
}

bool LagHistory::is_zero() const {
  return std::all_of(zero_.begin(), zero_.end(), [](char zero) { return zero != 0; });
}

void LagHistory::visit_state(StateArchive& state) {
  state(ring_, zero_, newest_);
  state.check(newest_ < ring_.size() || newest_ == 0);
  if (!state.restores() || !family_) return;
  for (std::size_t i = 0; i < ring_.size(); ++i)
    if (!zero_[i]) family_->analyse_columns(ring_[i], coefficients_[i]);
}

}  // namespace bem
