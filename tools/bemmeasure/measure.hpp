#pragma once

#include "trajectory.hpp"

#include <nlohmann/json.hpp>

namespace bem {

struct MeasureOptions {
  bool self = false;   ///< bodies against themselves, too
  std::string series;  ///< CSV file for every frame, if not empty
};

/// What a scene's trajectory shows, by its positions alone: the deepest penetration of every pair,
/// where the bodies went, their speeds and energy.
nlohmann::ordered_json measure(const Scene& scene, const Trajectory& trajectory,
                               const MeasureOptions& options);

}  // namespace bem
