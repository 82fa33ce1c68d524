#pragma once

#include <cstdint>
#include <string>

namespace bem {

/// Version of the layout described in docs/archive-format.md.
inline constexpr int kArchiveVersion = 2;

/// Bytes in front of the HDF5 file: a readable text, filled up with zeros.
inline constexpr std::uint64_t kUserBlock = 4096;

/// The text at the beginning of an archive; every byte of it is determined by these three.
struct UserBlock {
  int version = kArchiveVersion;
  std::uint64_t payload = 0;  ///< bytes after the user block
  std::string digest;         ///< tree_digest of them
};

/// Exactly kUserBlock bytes.
std::string user_block_bytes(const UserBlock& block);

/// Computes the digest of a complete HDF5 file, of which every write is known to have succeeded,
/// and writes its user block. Messages call the file by its `name`. Throws ErrorCode::resources.
void seal_archive(const std::string& path, const std::string& name);

/// Checks an archive before the HDF5 library sees it, which can crash on damaged files. Reads the
/// whole file once. Throws ErrorCode::archive if the file is missing, foreign, of a newer format
/// version, truncated or changed in any byte; ErrorCode::resources if it must not be read.
UserBlock verify_digest(const std::string& path);

}  // namespace bem
