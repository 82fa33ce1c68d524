#include "files/digest.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "files/file_io.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include <fcntl.h>
#include <xxhash.h>

namespace bem {
namespace {

constexpr std::uint64_t kDigestPiece = 256 << 10;  // stays in the second-level cache

struct FreeState {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};
using State = std::unique_ptr<XXH3_state_t, FreeState>;

/// Buffers of one worker thread.
struct Hasher {
  State state{XXH3_createState()};
  std::vector<char> buffer = std::vector<char>(kDigestPiece);
};

void read_exactly(int file, char* out, std::uint64_t size, std::uint64_t offset,
                  const std::string& path) {
  std::size_t got = 0;
  check_io(read_fully(file, out, size, offset, got), path, "cannot be read");
  if (got < size) throw Error(ErrorCode::archive, path + ": the archive cannot be read to its end");
}

std::string hexadecimal(XXH128_hash_t hash) {
  XXH128_canonical_t digest;
  XXH128_canonicalFromHash(&digest, hash);
  std::string hex;
  for (unsigned char byte : digest.digest) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

}  // namespace

std::string tree_digest(int file, std::uint64_t first, std::uint64_t length,
                        const std::string& path) {
  const auto blocks = static_cast<std::size_t>((length + kDigestBlock - 1) / kDigestBlock);
  std::vector<XXH128_canonical_t> digests(blocks);
  parallel_for(blocks, [&](std::size_t b) {
    thread_local Hasher hasher;
    XXH3_128bits_reset(hasher.state.get());
    const std::uint64_t begin = b * kDigestBlock, end = std::min(length, begin + kDigestBlock);
    for (std::uint64_t at = begin; at < end; at += kDigestPiece) {
      const std::uint64_t size = std::min(kDigestPiece, end - at);
      read_exactly(file, hasher.buffer.data(), size, first + at, path);
      XXH3_128bits_update(hasher.state.get(), hasher.buffer.data(), size);
    }
    XXH128_canonicalFromHash(&digests[b], XXH3_128bits_digest(hasher.state.get()));
  });
  return hexadecimal(XXH3_128bits(digests.data(), digests.size() * sizeof(XXH128_canonical_t)));
}

std::string file_digest(const std::string& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!file || unknown) throw Error(ErrorCode::resources, path + ": cannot be read");
  return tree_digest(file.get(), 0, size, path);
}

std::string digest_of(std::string_view bytes) {
  return hexadecimal(XXH3_128bits(bytes.data(), bytes.size()));
}

}  // namespace bem
