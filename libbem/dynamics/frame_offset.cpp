#include "dynamics/frame_offset.hpp"

#include "algebra/decompositions.hpp"

namespace bem {

FrameOffset::FrameOffset(const Scheme& scheme, double dt)
    : integration_(dt * scheme.integration()),
      theta_(scheme.theta()),
      multistep_(scheme.is_multistep()) {
  set_leak({});
}

void FrameOffset::set_leak(const Leak& leak) {
  leak_ = leak;
  const StageMatrix one = StageMatrix::Identity(integration_.rows(), integration_.cols());
  const StageMatrix system =
      one + leak.damping * integration_ + leak.stiffness * integration_ * integration_;
  solve_ = inverse(system);
  gain_ = integration_ * solve_ * integration_;
}

FrameOffset::State FrameOffset::base() const {
  if (!multistep_) return state_;
  const double now = (1 + theta_) / (1 + 0.5 * theta_), before = -0.5 * theta_ / (1 + 0.5 * theta_);
  State s;
  s.offset = now * state_.offset + before * previous_.offset;
  s.rate = now * state_.rate + before * previous_.rate;
  return s;
}

/// Rates at the stages (6 x s); stages are columns, so the integration matrix acts from the right.
Eigen::MatrixXd FrameOffset::rates(const State& start, const Eigen::MatrixXd& e) const {
  const Eigen::Index stages = e.cols();
  const Eigen::MatrixXd force = e - (leak_.stiffness * start.offset).replicate(1, stages);
  return (start.rate.replicate(1, stages) + force * integration_.transpose()) * solve_.transpose();
}

Eigen::MatrixXd FrameOffset::stages(const Eigen::MatrixXd& e) const {
  const State start = base();
  return start.offset.replicate(1, e.cols()) + rates(start, e) * integration_.transpose();
}

void FrameOffset::advance(const Eigen::MatrixXd& e) {
  const State start = base();
  const Eigen::MatrixXd rate = rates(start, e);
  const Eigen::MatrixXd offset =
      start.offset.replicate(1, e.cols()) + rate * integration_.transpose();
  previous_ = state_;
  state_.offset = offset.col(offset.cols() - 1);
  state_.rate = rate.col(rate.cols() - 1);
}

}  // namespace bem
