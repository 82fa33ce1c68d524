#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace bem {

/// Bytes of one section of a page, before they are compressed. Numbers are split into their bytes:
/// first the lowest byte of all, then the next, because alike bytes beside each other compress
/// better. viewer/unpacking.js reads what this writes.
class PackedSection {
 public:
  void add(const std::vector<std::uint8_t>& bytes);
  void add(const std::vector<std::uint16_t>& numbers) { add_planes(numbers); }
  void add(const std::vector<std::uint32_t>& numbers) { add_planes(numbers); }
  void add(const std::vector<float>& numbers) { add_planes(numbers); }
  void add(const std::vector<double>& numbers) { add_planes(numbers); }

  std::size_t size() const { return bytes_.size(); }
  /// The section as a page has it: compressed by zlib, in base 64.
  std::string text() const;

 private:
  template <class T>
  void add_planes(const std::vector<T>& numbers);

  std::vector<std::uint8_t> bytes_;
};

/// Single precision, as sections have most real numbers.
std::vector<float> to_floats(const std::vector<double>& numbers);

/// RFC 4648, with padding.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace bem
