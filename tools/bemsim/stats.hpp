#pragma once

#include "coarse_meshes.hpp"
#include "common/measure.hpp"
#include "growing_vibrations.hpp"
#include "plan.hpp"
#include "unmet_constraints.hpp"

namespace bem {

/// What happens in the course of a run, for --stats.
class RunStatistics {
 public:
  explicit RunStatistics(const Plan& plan) : vibrations_(plan.scene), coarse_(plan) {}
  /// Before the first step.
  void prepare(const Simulation& simulation) { coarse_.prepare(simulation); }
  /// Takes note of how the constraints of a step were met. Returns a description of the first step
  /// in which they were not.
  std::optional<std::string> record_step(const Simulation& simulation);
  void record_frame() { ++frames_; }
  long frames() const { return frames_; }
  void visit_state(StateArchive& state) {
    state(sum_, most_, unmet_, vibrations_, coarse_, contact_steps_, frames_);
  }
  /// What is wrong with the motion: constraints that were not met, vibrations that grow.
  std::vector<std::string> warnings(const Plan& plan, const Simulation& simulation) const;

  /// The file's contents. `outcome`: "complete", "interrupted" or "failed".
  nlohmann::ordered_json json(const Plan& plan, const Simulation& simulation,
                              const PhaseTimer& timer, const std::string& outcome) const;

 private:
  nlohmann::ordered_json constraints_json(long steps) const;

  ConstraintStatistics sum_, most_;  ///< over all steps
  UnmetConstraints unmet_;
  GrowingVibrations vibrations_;
  CoarseMeshes coarse_;
  long contact_steps_ = 0, frames_ = 0;
};

/// Names of the timer's phases.
inline constexpr const char* kLoadingPhase = "loading";
inline constexpr const char* kSteppingPhase = "stepping";
inline constexpr const char* kOutputPhase = "output";
inline constexpr const char* kCheckpointPhase = "checkpoint";

}  // namespace bem
