#pragma once

#include "simulation/simulation.hpp"

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// The steps of a run whose constraints were not met to their tolerances.
class UnmetConstraints {
 public:
  /// Returns a description of the step if it is the first one.
  std::optional<std::string> record(const Simulation& simulation);
  long steps() const { return steps_; }

  /// What was missed, how often and by how much, and what helps; nothing if all was met. `steps`:
  /// of the run. `impossible`: what bodies are asked to do that none can, or empty.
  std::optional<std::string> warning(long steps, const ContactSpec& contact,
                                     const std::string& impossible) const;
  /// Steps by what was not met.
  nlohmann::ordered_json json() const;
  void visit_state(StateArchive& state) {
    state(steps_, first_, joints_, contacts_, penetrations_, infeasible_, exhausted_);
  }

 private:
  struct Kind {
    long steps = 0;
    double worst = 0;  ///< [m]
    void add(double miss);
    void visit_state(StateArchive& state) {
      state(steps);
      state.any_numbers(worst);
    }
  };
  long steps_ = 0;
  double first_ = 0;  ///< time at the end of the first one [s]
  Kind joints_, contacts_, penetrations_;
  long infeasible_ = 0;  ///< steps in which no forces could keep all contacts apart
  long exhausted_ = 0;   ///< steps that took all the work allowed
};

}  // namespace bem
