#pragma once

#include "base/state_archive.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bem {

/// What a checkpoint knows of what frames have added to a file, or to the files of one body:
/// length and digest, which grow with each frame. The digest is a chain: XXH3-128 of the digest so
/// far and that of the piece that is added.
struct FileRecord {
  std::string name;  ///< in the output directory
  std::uint64_t bytes = 0;
  std::array<std::uint64_t, 2> digest{};

  void add(std::string_view piece);
  void visit_state(StateArchive& state) { state(name, bytes, digest); }
};

using FileRecords = std::vector<FileRecord>;

/// What differs, for people: empty if `found` is what is `expected`.
std::string difference(const FileRecords& expected, const FileRecords& found);

}  // namespace bem
