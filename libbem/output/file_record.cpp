#include "output/file_record.hpp"

#include <xxhash.h>

namespace bem {

void FileRecord::add(std::string_view piece) {
  const XXH128_hash_t own = XXH3_128bits(piece.data(), piece.size());
  const std::array<std::uint64_t, 4> both = {digest[0], digest[1], own.low64, own.high64};
  const XXH128_hash_t chained = XXH3_128bits(both.data(), sizeof both);
  digest = {chained.low64, chained.high64};
  bytes += piece.size();
}

std::string difference(const FileRecords& expected, const FileRecords& found) {
  if (expected.size() != found.size()) return "there are other files";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const FileRecord &a = expected[i], &b = found[i];
    if (a.name != b.name) return a.name + ": is missing";
    if (a.bytes != b.bytes)
      return a.name + ": has " + std::to_string(b.bytes) + " bytes of frames, not " +
             std::to_string(a.bytes);
    if (a.digest != b.digest) return a.name + ": its frames have changed";
  }
  return "";
}

}  // namespace bem
