#pragma once

#include "base/state_archive.hpp"
#include "base/types.hpp"

#include <optional>

namespace bem {

/// A vibration that a body's motion contains.
struct Vibration {
  double growth = 1;     ///< factor of its amplitude per step
  double frequency = 0;  ///< [periods per step]
  void visit_state(StateArchive& state) { state(growth, frequency); }
};

/// Finds vibrations of an undisturbed body that grow. Nothing in nature does that: it is the
/// negative damping that coarse meshes have, which bemprecomp measures for free bodies only.
///
/// A few weighted sums of the displacements are recorded. As long as nothing disturbs the body,
/// every sum is one of powers z^n, the same z for all, which linear prediction finds (Prony's
/// method; the recursion is linear and free of noise, so that |z| - 1 is right to about 1e-5). The
/// cost is that of reading the displacements.
class VibrationWatch {
 public:
  VibrationWatch();

  /// One more step; always as many displacements.
  void add(const Eigen::VectorXd& displacement);
  /// Something disturbs the body: what follows is another motion.
  void interrupt();

  /// The one that has grown fastest per step, if any has; those that grow by less than 0.2 % during
  /// 512 steps, make up less than 2 % of the motion, or are watched for less than two periods are
  /// left out.
  std::optional<Vibration> growing() const;

  void visit_state(StateArchive& state) {
    state(samples_, count_, found_);
    state.check(count_ >= 0 && count_ < samples_.cols());
  }

 private:
  Vibration examined() const;

  Eigen::MatrixXd weights_;  ///< signals x unknowns
  Eigen::MatrixXd samples_;  ///< signals x steps
  Eigen::Index count_ = 0;   ///< of steps recorded
  Vibration found_;
};

}  // namespace bem
