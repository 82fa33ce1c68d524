#include "packing.hpp"

#include "base/error.hpp"

#include <zlib.h>

namespace bem {
namespace {

constexpr int kLevel = 6;  // of zlib; 9 takes three times as long for one hundredth less

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::uint8_t> out(size);
  if (compress2(out.data(), &size, bytes.data(), bytes.size(), kLevel) != Z_OK)
    throw Error(ErrorCode::resources, "not enough memory to compress the page");
  out.resize(size);
  return out;
}

}  // namespace

void PackedSection::add(const std::vector<std::uint8_t>& bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

template <class T>
void PackedSection::add_planes(const std::vector<T>& numbers) {
  const std::size_t start = bytes_.size(), count = numbers.size();
  bytes_.resize(start + count * sizeof(T));
  const auto* from = reinterpret_cast<const std::uint8_t*>(numbers.data());
  for (std::size_t byte = 0; byte < sizeof(T); ++byte)
    for (std::size_t i = 0; i < count; ++i)
      bytes_[start + byte * count + i] = from[i * sizeof(T) + byte];
}

template void PackedSection::add_planes(const std::vector<std::uint16_t>&);
template void PackedSection::add_planes(const std::vector<std::uint32_t>&);
template void PackedSection::add_planes(const std::vector<float>&);
template void PackedSection::add_planes(const std::vector<double>&);

std::string PackedSection::text() const {
  return base64(deflated(bytes_));
}

std::vector<float> to_floats(const std::vector<double>& numbers) {
  std::vector<float> out(numbers.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(numbers[i]);
  return out;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char* const kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const std::uint32_t triple =
        bytes[i] << 16 | (left > 1 ? bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
    for (int digit = 0; digit < 4; ++digit)
      out += digit <= static_cast<int>(left) ? kDigits[triple >> (18 - 6 * digit) & 63] : '=';
  }
  return out;
}

}  // namespace bem
