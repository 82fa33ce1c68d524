#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace bem {

struct DifferenceOptions {
  double absolute = 0;              ///< in the unit of the numbers
  double relative = 0;              ///< of the largest number of a field of a body, all frames
  std::vector<std::string> fields;  ///< names in the file ("velocities", "series/momentum")
};

/// The largest difference of a field of a body.
struct FieldDifference {
  std::string body, field;
  double largest = 0;  ///< difference
  double allowed = 0;
  std::size_t frame = 0, vertex = 0;  ///< where it is

  bool is_equal() const { return largest <= allowed; }
};

/// Compares two trajectories with the same bodies, frames and times (to 1e-9 of a step), field by
/// field. Throws ErrorCode::invalid_input, naming what differs, if they do not have the same, and
/// ErrorCode::archive if a file is no trajectory.
std::vector<FieldDifference> compare_trajectories(const std::string& a, const std::string& b,
                                                  const DifferenceOptions& options);

}  // namespace bem
