#pragma once

#include "packing.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bem {

/// From what a frame of quantised numbers is predicted. The values are part of the page's format.
enum class Prediction : std::uint8_t {
  within = 0,    ///< each number from the same component of the vertex before
  previous = 1,  ///< from the frame before
  linear = 2     ///< from the two frames before: 2 a - b
};

/// Frames of quantised numbers as differences from their predictions, which are small where motions
/// are smooth and compress well. Begins anew with every segment of a page, so that segments can be
/// read one by one.
class PredictedFrames {
 public:
  /// `components`: numbers per vertex.
  explicit PredictedFrames(std::size_t components) : components_(components) {}

  /// Adds a frame; all frames of a segment have the same length.
  void add(const std::vector<std::uint16_t>& frame);
  /// Writes the kinds of prediction, then all differences; the next frame begins a segment.
  void flush(PackedSection& section);

 private:
  std::vector<std::uint16_t> differences(const std::vector<std::uint16_t>& frame,
                                         Prediction kind) const;

  std::size_t components_;
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint16_t> differences_;
  std::vector<std::uint16_t> last_, before_last_;  ///< frames of this segment
};

/// Differences modulo 2^16 as numbers that are small where the difference is, whatever its sign:
/// 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
constexpr std::uint16_t folded(std::uint16_t difference) {
  const int wide = difference;
  return static_cast<std::uint16_t>(wide < 0x8000 ? 2 * wide : 2 * (0xffff - wide) + 1);
}

}  // namespace bem
