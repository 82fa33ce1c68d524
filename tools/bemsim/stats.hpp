#pragma once

#include "common/measure.hpp"
#include "simulation/simulation.hpp"
#include "plan.hpp"

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// What happens in the course of a run, for --stats.
class RunStatistics {
 public:
  explicit RunStatistics(std::size_t bodies) : bodies_(bodies) {}

  /// Takes note of how the constraints of a step were met.
  void record_step(const Simulation& simulation);
  void record_frame() { ++frames_; }
  long frames() const { return frames_; }

  /// The file's contents. `outcome`: "complete", "interrupted" or "failed".
  nlohmann::ordered_json json(const Plan& plan, const Simulation& simulation,
                              const PhaseTimer& timer, const std::string& outcome) const;

 private:
  struct BodyRecord {
    long iterations = 0;
    int most_iterations = 0;
    double largest_residual = 0;  ///< [m]
  };

  nlohmann::ordered_json body_json(const PlannedBody& planned, const Body& body,
                                   const BodyRecord& record, long steps) const;

  std::vector<BodyRecord> bodies_;
  long frames_ = 0;
};

/// Names of the timer's phases.
inline constexpr const char* kLoadingPhase = "loading";
inline constexpr const char* kSteppingPhase = "stepping";
inline constexpr const char* kOutputPhase = "output";

}  // namespace bem
