#include "common/progress_bar.hpp"

#include "common/measure.hpp"

#include <algorithm>

namespace bem {

std::string progress_text(const std::string& phase, double fraction, double elapsed_seconds) {
  constexpr std::size_t kWidth = 30, kNameWidth = 18;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(fraction * kWidth);
  std::string text = phase + std::string(kNameWidth - std::min(kNameWidth, phase.size()), ' ');
  if (fraction == 0) return text + " ...";
  text += " [" + std::string(filled, '#') + std::string(kWidth - filled, ' ') + "] " +
          std::to_string(static_cast<int>(100 * fraction)) + " %";
  if (fraction < 1)
    text += ", " + seconds_text(elapsed_seconds * (1 - fraction) / fraction) + " left";
  return text;
}

void ProgressBar::update(const std::string& phase, double fraction) {
  if (!log_.shows_status()) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  const bool begins = phase != phase_;
  if (begins) {
    phase_ = phase;
    phase_start_ = now;
  } else if (now - last_shown_ < std::chrono::milliseconds(100) && fraction < 1) {
    return;
  }
  last_shown_ = now;
  log_.set_status(
      progress_text(phase, fraction, std::chrono::duration<double>(now - phase_start_).count()));
}

void ProgressBar::finish() {
  const std::lock_guard lock(mutex_);
  phase_.clear();
  log_.set_status("");
}

}  // namespace bem
