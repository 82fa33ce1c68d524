#include "prediction.hpp"

#include "base/error.hpp"

#include <numeric>

namespace bem {

std::vector<std::uint16_t> PredictedFrames::differences(const std::vector<std::uint16_t>& frame,
                                                        Prediction kind) const {
  std::vector<std::uint16_t> out(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    int predicted = 0;
    if (kind == Prediction::within)
      predicted = i < components_ ? 0 : frame[i - components_];
    else if (kind == Prediction::previous)
      predicted = last_[i];
    else
      predicted = 2 * last_[i] - before_last_[i];
    out[i] = folded(static_cast<std::uint16_t>(frame[i] - predicted));
  }
  return out;
}

void PredictedFrames::add(const std::vector<std::uint16_t>& frame) {
  require(kinds_.empty() || frame.size() == last_.size(), "frames of a segment are alike");
  const std::size_t known = kinds_.size();
  Prediction kind = known == 0 ? Prediction::within : Prediction::previous;
  std::vector<std::uint16_t> best = differences(frame, kind);
  const auto sum = [](const auto& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  if (known > 1) {
    std::vector<std::uint16_t> other = differences(frame, Prediction::linear);
    if (sum(other) < sum(best)) {
      best.swap(other);
      kind = Prediction::linear;
    }
  }
  kinds_.push_back(static_cast<std::uint8_t>(kind));
  differences_.insert(differences_.end(), best.begin(), best.end());
  before_last_.swap(last_);
  last_ = frame;
}

void PredictedFrames::flush(PackedSection& section) {
  section.add(kinds_);
  section.add(differences_);
  kinds_.clear();
  differences_.clear();
}

}  // namespace bem
