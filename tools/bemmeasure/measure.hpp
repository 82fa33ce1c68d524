#pragma once

#include "trajectory.hpp"

#include <nlohmann/json.hpp>

namespace bem {

struct MeasureOptions {
  bool self = false;     ///< bodies against themselves, too
  std::string series;    ///< CSV file for every frame, if not empty
  std::string contacts;  ///< CSV file of all contacts, if not empty
};

/// What a scene's trajectory shows by its positions: the deepest penetration of every pair,
/// where the bodies went, their speeds and energy. Velocities are differences of two frames, so
/// they belong to the middle between them, and an impact in between is smeared. The CSV files add
/// what the trajectory has recorded (recorded.hpp).
nlohmann::ordered_json measure(const Scene& scene, const Trajectory& trajectory,
                               const MeasureOptions& options);

}  // namespace bem
