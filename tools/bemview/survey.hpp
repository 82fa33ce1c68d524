#pragma once

#include "recording.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bem {

/// A quantity of a body in every shown frame, for the plot.
struct ViewSeries {
  std::string name, units;
  std::size_t body = 0;
  std::size_t components = 1;   ///< 1 or 3
  std::vector<double> numbers;  ///< [frames x components]
};

/// Range of a field over all bodies and frames.
struct FieldRange {
  double most = 0;  ///< largest value: that of the quantisation
  double top = 0;   ///< a round number that at most one value in 500 exceeds: that of the colours
};

/// What has to be known of a whole recording before the first frame can be written.
struct Survey {
  std::vector<PositionGrid> grids;   ///< of the bodies, in the axes of their frames
  std::vector<FieldRange> ranges;    ///< of the fields
  PositionGrid bounds;               ///< of everything, in the world
  std::vector<ViewSeries> measured;  ///< by positions: height and largest displacement
};

/// Reads all frames once. `progress` is called with the share that is done.
Survey survey(const Recording& recording, const std::function<void(double)>& progress);

/// The series that the trajectory has.
std::vector<ViewSeries> recorded_series(const Recording& recording);

/// The least of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not less; 0 of 0.
double round_above(double value);

}  // namespace bem
