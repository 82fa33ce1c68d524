#include "archive/user_block.hpp"

#include "base/error.hpp"
#include "files/digest.hpp"
#include "files/file_io.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>

namespace bem {
namespace {

constexpr char kMagic[] = "bem matrix archive\nformat version: ";
constexpr char kPayloadLine[] = "\nbytes after the first 4096: ";
constexpr char kDigestLine[] = "\nxxh3-128 tree digest of them: ";
constexpr char kNote[] =
    "\n\nThis is an HDF5 file behind a user block of 4096 bytes, which is this text.\n"
    "`bemprecomp --info FILE` says what is in it; docs/archive-format.md describes it.\n";
constexpr std::uint64_t kDigits = 32;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorCode::archive, path + ": " + what);
}

[[noreturn]] void damaged(const std::string& path, const std::string& what) {
  refuse(path,
         "the archive is damaged: " + what + "; copy it again or make it again with bemprecomp");
}

FileDescriptor open_archive(const std::string& path, std::uint64_t& size) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file && (errno == ENOENT || errno == ENOTDIR))
    refuse(path, "no such archive; bemprecomp makes one");
  if (!file && (errno == ELOOP || errno == ENAMETOOLONG))
    refuse(path, std::string("no such archive (") + std::strerror(errno) + ")");
  if (!file)
    throw Error(ErrorCode::resources,
                path + ": the archive cannot be read (" + std::strerror(errno) + ")");
  struct stat status {};
  if (::fstat(file.get(), &status) != 0 || !(S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)))
    refuse(path, "is not a file, let alone an archive");
  if (S_ISDIR(status.st_mode)) refuse(path, "is a directory, not an archive");
  size = static_cast<std::uint64_t>(status.st_size);
  return file;
}

std::string read_user_block(const FileDescriptor& file, const std::string& path) {
  std::string bytes(kUserBlock, '\0');
  std::size_t have = 0;
  check_io(read_fully(file.get(), bytes.data(), bytes.size(), 0, have), path, "cannot be read");
  bytes.resize(have);
  return bytes;
}

bool starts_with(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Moves `at` behind `label` and the number that follows it.
template <class Integer>
bool read_number(const std::string& text, std::size_t& at, const char* label, Integer& value) {
  const std::size_t length = std::strlen(label);
  if (text.compare(at, length, label) != 0) return false;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + at + length, end, value);
  at = static_cast<std::size_t>(result.ptr - text.data());
  return result.ec == std::errc();
}

UserBlock parse_user_block(const std::string& path, const std::string& bytes) {
  if (bytes.empty()) refuse(path, "is empty, not an archive");
  if (starts_with(bytes, "\x89HDF\r\n\x1a\n"))
    refuse(path, "is an HDF5 file, but not an archive of bemprecomp");
  const std::string magic = kMagic;
  if (!starts_with(bytes, magic.substr(0, bytes.size())))
    refuse(path, "is not an archive of bemprecomp");
  if (bytes.size() < kUserBlock)
    damaged(path, "it ends after " + std::to_string(bytes.size()) + " bytes");
  UserBlock block;
  std::size_t at = 0;
  if (!read_number(bytes, at, kMagic, block.version)) damaged(path, "its header is not readable");
  if (block.version > kArchiveVersion)
    refuse(path, "is an archive of format version " + std::to_string(block.version) +
                     ", but this program knows versions up to " + std::to_string(kArchiveVersion) +
                     "; update the program");
  if (!read_number(bytes, at, kPayloadLine, block.payload) ||
      bytes.compare(at, std::strlen(kDigestLine), kDigestLine) != 0)
    damaged(path, "its header is not readable");
  block.digest = bytes.substr(at + std::strlen(kDigestLine), kDigits);
  if (user_block_bytes(block) != bytes) damaged(path, "its header was changed");
  return block;
}

}  // namespace

std::string user_block_bytes(const UserBlock& block) {
  std::string bytes = kMagic + std::to_string(block.version) + kPayloadLine +
                      std::to_string(block.payload) + kDigestLine + block.digest + kNote;
  bytes.resize(kUserBlock, '\0');
  return bytes;
}

void seal_archive(const std::string& path, const std::string& name) {
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW));
  struct stat status {};
  check_io(file && ::fstat(file.get(), &status) == 0 ? 0 : errno, name);
  UserBlock block;
  block.payload = static_cast<std::uint64_t>(status.st_size) - kUserBlock;
  block.digest = tree_digest(file.get(), kUserBlock, block.payload, name);
  const std::string bytes = user_block_bytes(block);
  check_io(write_fully(file.get(), bytes.data(), bytes.size(), 0), name);
  check_io(close_file(file), name);
}

UserBlock verify_digest(const std::string& path) {
  std::uint64_t size = 0;
  const FileDescriptor file = open_archive(path, size);
  const UserBlock block = parse_user_block(path, read_user_block(file, path));
  if (size != kUserBlock + block.payload)
    damaged(path, "it has " + std::to_string(size) + " bytes, but was written with " +
                      std::to_string(kUserBlock + block.payload));
  const std::string digest = tree_digest(file.get(), kUserBlock, block.payload, path);
  if (digest != block.digest)
    damaged(path, "the digest of its contents is " + digest + ", but was " + block.digest +
                      " when it was written");
  return block;
}

}  // namespace bem
