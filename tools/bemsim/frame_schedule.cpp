#include "frame_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace bem {

FrameSchedule FrameSchedule::every_steps(int every) {
  return FrameSchedule(every);
}

FrameSchedule FrameSchedule::per_second(double fps, double time_step) {
  constexpr double kLongest = 1e15;  // beyond any run; keeps the products exact
  return FrameSchedule(std::clamp(1 / (fps * time_step), 1.0, kLongest));
}

long FrameSchedule::step_of(long frame) const {
  return std::lround(static_cast<double>(frame) * interval_);
}

bool FrameSchedule::contains(long step) const {
  return step_of(std::lround(static_cast<double>(step) / interval_)) == step;
}

long FrameSchedule::count(long steps) const {
  long last = std::lround(static_cast<double>(steps) / interval_);
  if (step_of(last) > steps) --last;
  return last + 1;
}

}  // namespace bem
