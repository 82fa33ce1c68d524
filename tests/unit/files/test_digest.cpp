#include "base/error.hpp"
#include "base/parallel.hpp"
#include "files/digest.hpp"
#include "files/file_descriptor.hpp"
#include "support/archives.hpp"

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <xxhash.h>

using namespace bem;

namespace {

/// The definition in docs/archive-format.md, word for word, on a file in memory.
std::string reference_digest(const std::string& bytes) {
  std::string digests;
  for (std::size_t at = 0; at < bytes.size(); at += 8388608) {
    XXH128_canonical_t block;
    XXH128_canonicalFromHash(
        &block, XXH3_128bits(bytes.data() + at, std::min<std::size_t>(8388608, bytes.size() - at)));
    digests.append(reinterpret_cast<const char*>(block.digest), 16);
  }
  XXH128_canonical_t root;
  XXH128_canonicalFromHash(&root, XXH3_128bits(digests.data(), digests.size()));
  char hex[33];
  for (int i = 0; i < 16; ++i) std::snprintf(hex + 2 * i, 3, "%02x", root.digest[i]);
  return hex;
}

std::string pattern(std::size_t size) {
  std::string bytes(size, '\0');
  std::uint32_t state = 1;
  for (char& c : bytes) c = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  return bytes;
}

std::string digest_of(const std::string& path, std::uint64_t first, std::uint64_t length) {
  const FileDescriptor file(open(path.c_str(), O_RDONLY));
  return tree_digest(file.get(), first, length, path);
}

}  // namespace

TEST_CASE("The digest is that of the digests of 8 MiB blocks") {
  const test::TemporaryFolder folder("digest");
  const std::string all = pattern((2 << 23) + 12345);
  bem_test::write_bytes(folder / "file", all);
  for (std::size_t length : {std::size_t(0), std::size_t(1), std::size_t(300000),
                             std::size_t(8) << 20, (std::size_t(8) << 20) + 1, all.size() - 100}) {
    CAPTURE(length);
    CHECK(digest_of(folder / "file", 100, length) == reference_digest(all.substr(100, length)));
  }
  const int threads = thread_count();
  set_thread_count(1);
  const std::string one = digest_of(folder / "file", 0, all.size());
  set_thread_count(2);
  CHECK(digest_of(folder / "file", 0, all.size()) == one);
  set_thread_count(threads);
}

TEST_CASE("The digest of a file that ends too early is an archive error") {
  const test::TemporaryFolder folder("digest_short");
  bem_test::write_bytes(folder / "file", "abc");
  const auto [code, message] = bem_test::error_of([&] { digest_of(folder / "file", 0, 4); });
  CHECK(code == 4);
  CHECK(message.find("cannot be read to its end") != std::string::npos);
}
