#pragma once

#include "base/choices.hpp"

namespace bem {

/// Number format of uncompressed matrix entries.
enum class Precision { float32, float64 };

template <>
struct Choices<Precision> {
  static constexpr std::array<Choice<Precision>, 2> all = {
      {{Precision::float32, "float32"}, {Precision::float64, "float64"}}};
};

class Codec;

/// A codec, and how much of the matrices it may lose.
struct CodecOptions {
  CodecOptions();
  explicit CodecOptions(const Codec& c, double t = 1e-4, double r = 0)
      : codec(&c), tolerance(t), ratio(r) {}

  const Codec* codec;  ///< "none" with single precision by default
  /// Error of the matrices aimed at, relative to their Frobenius norm (of all lags together).
  double tolerance = 1e-4;
  /// Codec haar: entries before / coefficients kept; 0: as many as the tolerance asks for.
  double ratio = 0;
};

}  // namespace bem
