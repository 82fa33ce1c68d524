#include "model/motion_history.hpp"

#include "algebra/decompositions.hpp"
#include "model/body_model.hpp"

#include <algorithm>

namespace bem {
namespace {

/// S_j of a scheme whose weights of lag k have the factor window^k, see Scheme::windowed().
std::vector<StageMatrix> acceleration_series(const Scheme& scheme, double window) {
  std::vector<StageMatrix> series = delta_polynomial(scheme, {0, 0, 1});
  const StageVector& times = scheme.stage_times();
  for (std::size_t j = 0; j < series.size(); ++j)
    for (Eigen::Index a = 0; a < times.size(); ++a)
      for (Eigen::Index b = 0; b < times.size(); ++b)
        series[j](a, b) *= std::pow(window, static_cast<double>(j) + times[a] - times[b]);
  return series;
}

}  // namespace

MotionHistory::MotionHistory(const BodyModel& model, double window)
    : lags_(model.discretisation.scheme.windowed(window),
            static_cast<Eigen::Index>(3 * model.nodes()), model.discretisation.history_length,
            window, model.h.get()) {
  const Scheme& scheme = model.discretisation.scheme;
  unaccelerated_ =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * model.nodes()), scheme.stages());
  if (!model.stiffness) return;
  const std::vector<StageMatrix> series = acceleration_series(scheme, window);
  const double dt = model.discretisation.dt;
  acceleration_ = series[0] / (dt * dt);
  for (std::size_t j = 1; j < series.size(); ++j)
    forward_.emplace_back(-(StageMatrix(inverse(series[0])) * series[j]));
  past_.assign(forward_.size(), unaccelerated_);
}

/// Stages are columns, so the matrices act from the right.
void MotionHistory::predict() {
  unaccelerated_.setZero();
  for (std::size_t j = 0; j < forward_.size(); ++j)
    unaccelerated_.noalias() += past_[j] * forward_[j].transpose();
}

void MotionHistory::push(const Eigen::MatrixXd& displacements) {
  if (forward_.empty()) {
    lags_.push(displacements);
    return;
  }
  lags_.push((displacements - unaccelerated_) * acceleration_.transpose());
  std::rotate(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = displacements;
  predict();
}

void MotionHistory::visit_state(StateArchive& state) {
  state(lags_);
  if (forward_.empty()) return;
  state(past_);
  if (state.restores()) predict();
}

}  // namespace bem
