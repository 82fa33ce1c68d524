#pragma once

#include "compress/codec.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bem {

/// Magnitudes of single precision numbers by size, 128 classes per factor of two: how many there
/// are, or the sum of their squares.
class MagnitudeHistogram {
 public:
  enum class Weight { count, square };
  explicit MagnitudeHistogram(Weight weight) : weight_(weight), sums_(kClasses, 0.0) {}

  void add(float value) {
    const double square = static_cast<double>(value) * static_cast<double>(value);
    squares_ += square;
    sums_[class_of(value)] += weight_ == Weight::count ? 1.0 : square;
  }
  void add(const MagnitudeHistogram& other);

  static std::size_t class_of(float value);
  /// The smallest magnitude in a class, and of all beyond the last one.
  static float edge(std::size_t magnitude_class);
  static constexpr std::size_t kClasses = std::size_t(1) << 15;

  const std::vector<double>& sums() const { return sums_; }
  double squares() const { return squares_; }
  /// At least the largest magnitude.
  float largest() const;

 private:
  Weight weight_;
  std::vector<double> sums_;
  double squares_ = 0;
};

/// Which of all coefficients of a family are kept: the largest ones, so many as a ratio asks for,
/// or so that the squares of the others sum up to what a tolerance allows.
class HaarSelection {
 public:
  /// `entries`: of all matrices.
  HaarSelection(const CodecOptions& options, std::size_t entries);

  MagnitudeHistogram histogram() const { return MagnitudeHistogram(weight_); }
  /// Coefficients, `count` of them, that have come so far.
  void add(const MagnitudeHistogram& coefficients, std::size_t count);

  /// Smaller ones will not be kept, whatever is still to come.
  float least() const { return MagnitudeHistogram::edge(least_); }
  /// For a ratio the number to keep; the class of magnitudes from which on this decides is that
  /// of least(). 0 for a tolerance.
  std::size_t kept_by_ratio() const { return kept_; }
  const MagnitudeHistogram& seen() const { return seen_; }

 private:
  MagnitudeHistogram::Weight weight_;
  std::size_t unseen_, kept_ = 0;
  double allowed_ = 0;  ///< sum of the squares lost over that of all
  MagnitudeHistogram seen_;
  std::size_t least_ = 0;
};

/// Half precision where it adds little to an error of `tolerance`.
bool haar_half_precision(double tolerance);

}  // namespace bem
