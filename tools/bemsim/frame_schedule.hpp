#pragma once

namespace bem {

/// Which steps of a run are written. Step 0 always is.
class FrameSchedule {
 public:
  /// Every `every`-th step, every >= 1.
  static FrameSchedule every_steps(int every);
  /// Frame k is the step nearest to the time k/fps; every step if they are not closer than that.
  static FrameSchedule per_second(double fps, double time_step);

  bool contains(long step) const;
  /// Number of frames of a run with this many steps, frame 0 included.
  long count(long steps) const;

 private:
  explicit FrameSchedule(double interval) : interval_(interval) {}
  long step_of(long frame) const;

  double interval_;  ///< steps from frame to frame, >= 1
};

}  // namespace bem
