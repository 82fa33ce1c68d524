#pragma once

#include "common/log.hpp"

#include <chrono>
#include <mutex>

namespace bem {

/// Shows phase, bar and remaining time of the phase on the log's status line (on a terminal only).
/// Thread safe; cheap enough to be called for every tile of work.
class ProgressBar {
 public:
  explicit ProgressBar(Log& log) : log_(log) {}
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(const std::string& phase, double fraction);
  void finish();  ///< removes the bar

 private:
  using Clock = std::chrono::steady_clock;

  Log& log_;
  std::mutex mutex_;
  std::string phase_;
  Clock::time_point phase_start_, last_shown_;
};

/// "assembly    [#####     ]  50 %, 1 min 10 s left"; no time while nothing is done.
std::string progress_text(const std::string& phase, double fraction, double elapsed_seconds);

}  // namespace bem
