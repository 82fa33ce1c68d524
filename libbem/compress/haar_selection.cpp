#include "compress/haar_selection.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace bem {
namespace {

constexpr double kHalfError = 2.5e-4;  // relative, of many numbers rounded to half precision
constexpr int kDropped = 16;           // bits of a float that do not count for its class

}  // namespace

bool haar_half_precision(double tolerance) {
  return tolerance >= 2 * kHalfError;
}

std::size_t MagnitudeHistogram::class_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return (bits & 0x7fffffffU) >> kDropped;
}

float MagnitudeHistogram::edge(std::size_t magnitude_class) {
  const std::uint32_t bits = static_cast<std::uint32_t>(magnitude_class) << kDropped;
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void MagnitudeHistogram::add(const MagnitudeHistogram& other) {
  for (std::size_t c = 0; c < kClasses; ++c) sums_[c] += other.sums_[c];
  squares_ += other.squares_;
}

float MagnitudeHistogram::largest() const {
  for (std::size_t c = kClasses; c > 0; --c)
    if (sums_[c - 1] > 0) return edge(c);
  return 0;
}

HaarSelection::HaarSelection(const CodecOptions& options, std::size_t entries)
    : weight_(options.ratio > 0 ? MagnitudeHistogram::Weight::count
                                : MagnitudeHistogram::Weight::square),
      unseen_(entries),
      seen_(weight_) {
  if (options.ratio > 0) {
    kept_ = static_cast<std::size_t>(
        std::max(1.0, std::floor(static_cast<double>(entries) / options.ratio)));
    return;
  }
  allowed_ = options.tolerance * options.tolerance;
  if (haar_half_precision(options.tolerance)) allowed_ -= kHalfError * kHalfError;
}

void HaarSelection::add(const MagnitudeHistogram& coefficients, std::size_t count) {
  seen_.add(coefficients);
  unseen_ -= count;
  const std::vector<double>& sums = seen_.sums();
  if (weight_ == MagnitudeHistogram::Weight::count) {
    double larger = 0;  // in class least_ and beyond; the last ones kept are in class least_
    for (least_ = MagnitudeHistogram::kClasses; least_ > 0; --least_) {
      if (larger >= static_cast<double>(kept_)) break;
      larger += sums[least_ - 1];
    }
    return;
  }
  const double allowed = allowed_ * seen_.squares();
  double lost = 0;
  const std::size_t infinite = MagnitudeHistogram::class_of(std::numeric_limits<float>::infinity());
  for (least_ = 0; least_ + 1 < infinite; ++least_) {
    const auto next = static_cast<double>(MagnitudeHistogram::edge(least_ + 1));
    lost += sums[least_];
    if (lost + next * next * static_cast<double>(unseen_) > allowed) break;
  }
}

}  // namespace bem
