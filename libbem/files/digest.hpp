#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace bem {

/// Size of the blocks that are hashed one by one [bytes].
inline constexpr std::uint64_t kDigestBlock = std::uint64_t(8) << 20;

/// XXH3-128 tree digest of `length` bytes from `first` of an open file, as 32 hexadecimal digits:
/// the digest of the digests (16 bytes each, in canonical order) of all blocks of kDigestBlock
/// bytes, the last of which may be shorter. Blocks are hashed in parallel and read in small pieces,
/// so that neither the file nor a block is ever in memory. Throws ErrorCode::archive naming `path`
/// if there are fewer bytes, ErrorCode::resources if they cannot be read.
std::string tree_digest(int file, std::uint64_t first, std::uint64_t length,
                        const std::string& path);

/// tree_digest of a whole file. Throws ErrorCode::resources if it cannot be read.
std::string file_digest(const std::string& path);

/// XXH3-128 digest of some bytes, as 32 hexadecimal digits.
std::string digest_of(std::string_view bytes);

}  // namespace bem
