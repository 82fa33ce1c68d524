#pragma once

#include "model/lag_history.hpp"

namespace bem {

struct BodyModel;

/// Past displacements of a body in the form that the lag matrices of its model multiply:
/// displacements (collocation), or the accelerations that the time discretisation makes of them,
///   a_n = sum_j S_j u_{n-j} / dt^2,   sum_j S_j zeta^j = Delta(zeta)^2
/// (the inertial form of the Galerkin method, see docs/method.md). There the unknown of a step is
/// what is added to the motion without acceleration.
class MotionHistory {
 public:
  MotionHistory() = default;
  /// `scheme`: of the model; `window`: factor per lag. The model must outlive this.
  MotionHistory(const BodyModel& model, double window);

  /// Makes the displacements at the stages (3N x s) [m] those of lag 1.
  void push(const Eigen::MatrixXd& displacements);
  void visit_state(StateArchive& state);

  const LagHistory& lags() const { return lags_; }
  /// Displacements at the stages of the next step with which its accelerations are zero, 3N x s;
  /// zero if the lag matrices multiply displacements.
  const Eigen::MatrixXd& unaccelerated() const { return unaccelerated_; }
  /// Number of last displacements that all of this depends on.
  int reach() const { return lags_.length() + static_cast<int>(past_.size()); }

 private:
  void predict();

  LagHistory lags_;
  StageMatrix acceleration_;           ///< S_0 / dt^2
  std::vector<StageMatrix> forward_;   ///< -S_0^{-1} S_j, j >= 1; empty for displacements
  std::vector<Eigen::MatrixXd> past_;  ///< displacements, newest first
  Eigen::MatrixXd unaccelerated_;
};

}  // namespace bem
