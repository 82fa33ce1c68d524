#pragma once

#include "base/state_archive.hpp"

#include <chrono>

namespace bem {

/// Wall-clock seconds by phase, summed over all steps.
struct PhaseTimes {
  double unconstrained = 0;  ///< products with the history, motion without contact
  double collision = 0;      ///< detection
  double constraints = 0;    ///< frame, loads, joints and contacts
  double correction = 0;     ///< displacements of the new step, history
  void visit_state(StateArchive& state) {
    state(unconstrained, collision, constraints, correction);
  }
};

/// Adds the seconds of its own life to one of them.
class PhaseStopwatch {
 public:
  explicit PhaseStopwatch(double& sum) : sum_(sum) {}
  PhaseStopwatch(const PhaseStopwatch&) = delete;
  PhaseStopwatch& operator=(const PhaseStopwatch&) = delete;
  ~PhaseStopwatch() {
    sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace bem
