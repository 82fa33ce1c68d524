#pragma once

#include "prediction.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <zlib.h>

namespace bem::test {

inline std::vector<std::uint8_t> from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> out;
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    out.push_back(static_cast<std::uint8_t>(bits >> count));
  }
  return out;
}

/// Reads a section of a page as viewer/unpacking.js does.
class Unpacked {
 public:
  /// `size`: bytes of the section, which must be right.
  Unpacked(const std::string& text, std::size_t size) : bytes_(size) {
    const std::vector<std::uint8_t> packed = from_base64(text);
    uLongf found = size;
    if (uncompress(bytes_.data(), &found, packed.data(), packed.size()) != Z_OK || found != size)
      throw std::runtime_error("the section has another size");
  }

  template <class T>
  std::vector<T> numbers(std::size_t count) {
    std::vector<T> out(count);
    auto* to = reinterpret_cast<std::uint8_t*>(out.data());
    for (std::size_t byte = 0; byte < sizeof(T); ++byte)
      for (std::size_t i = 0; i < count; ++i) to[i * sizeof(T) + byte] = bytes_.at(at_++);
    return out;
  }

  /// Frames of `length` numbers, one after another.
  std::vector<std::uint16_t> frames(std::size_t count, std::size_t length, std::size_t components) {
    const auto kinds = numbers<std::uint8_t>(count);
    std::vector<std::uint16_t> out = numbers<std::uint16_t>(count * length);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto kind = static_cast<Prediction>(kinds[i / length]);
      int predicted = 0;
      if (kind == Prediction::previous) predicted = out[i - length];
      if (kind == Prediction::linear) predicted = 2 * out[i - length] - out[i - 2 * length];
      if (kind == Prediction::within && i % length >= components) predicted = out[i - components];
      const int difference = out[i] % 2 == 1 ? -(out[i] / 2) - 1 : out[i] / 2;
      out[i] = static_cast<std::uint16_t>(predicted + difference);
    }
    return out;
  }

  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace bem::test
