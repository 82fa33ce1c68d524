#pragma once

#include "base/state_archive.hpp"
#include "base/text.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace bem {

/// Largest resident memory of this process so far [bytes].
std::size_t peak_memory();

/// Memory of the machine, or what a control group leaves to this process if that is less [bytes].
std::size_t physical_memory();

/// Time spent in the phases of a run, which follow one another. Not thread safe.
class PhaseTimer {
 public:
  struct Phase {
    std::string name;
    double wall_seconds = 0;
    double cpu_seconds = 0;       ///< of all threads
    std::size_t peak_memory = 0;  ///< of the process, at the end of the phase [bytes]
    void visit_state(StateArchive& state) { state(name, wall_seconds, cpu_seconds, peak_memory); }
  };

  /// Ends the current phase, if any, and begins another; one that was there before goes on.
  void begin(const std::string& name);
  void end();
  /// Ends the current phase. What is restored is added to what there is.
  void visit_state(StateArchive& state);

  const std::vector<Phase>& phases() const { return phases_; }
  double total_wall_seconds() const;

 private:
  std::vector<Phase> phases_;
  std::size_t current_ = 0;
  bool running_ = false;
  double wall_start_ = 0, cpu_start_ = 0;
};

}  // namespace bem
