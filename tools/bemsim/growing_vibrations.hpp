#pragma once

#include "dynamics/vibration_watch.hpp"
#include "simulation/simulation.hpp"

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// Vibrations of held bodies of a scene that grow although nothing drives them. Bodies are watched
/// while nothing touches or moves them and their loads are constant.
class GrowingVibrations {
 public:
  explicit GrowingVibrations(const Scene& scene);

  /// One more step.
  void record(const Simulation& simulation);
  /// For every body with a vibration that grows noticeably in that many steps: how fast, and what
  /// helps.
  std::vector<std::string> warnings(const Simulation& simulation, long steps) const;
  /// What has been found of a body of the scene: null, or frequency [Hz] and growth per step.
  nlohmann::ordered_json json(std::size_t body, double time_step) const;

  void visit_state(StateArchive& state);

 private:
  struct Watched {
    std::size_t body;
    double quiet_from;  ///< the time when its loads have become constant [s]
    VibrationWatch watch;
  };
  std::vector<Watched> watched_;
};

}  // namespace bem
