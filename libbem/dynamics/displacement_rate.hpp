#pragma once

#include "base/state_archive.hpp"
#include "kernels/scheme.hpp"

#include <vector>

namespace bem {

/// How fast displacements change at the end of a step, as the time discretisation differentiates:
/// u' = sum_m Delta_m u_{n-m} / dt at the last stage, Delta(zeta) = sum_m Delta_m zeta^m. Before
/// the first step there are no displacements.
class DisplacementRate {
 public:
  /// dt: time step [s]; `unknowns`: rows of what is pushed.
  DisplacementRate(const Scheme& scheme, double dt, Eigen::Index unknowns);

  /// Displacements at the stages of a step that has ended, unknowns x s [m].
  void push(const Eigen::MatrixXd& stages);
  /// [m/s]
  Eigen::VectorXd value() const;
  void visit_state(StateArchive& state) { state(past_); }

 private:
  std::vector<StageVector> weights_;   ///< of the stages of a step, newest step first [1/s]
  std::vector<Eigen::MatrixXd> past_;  ///< displacements, likewise
};

}  // namespace bem
