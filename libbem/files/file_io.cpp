#include "files/file_io.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>

namespace bem {
namespace {

/// Calls until no signal interrupts.
template <class Call>
auto uninterrupted(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

template <class Call>
int error_of(const Call& call) {
  return uninterrupted(call) == 0 ? 0 : errno;
}

constexpr std::size_t kLargest = std::size_t(1) << 30;  // the system takes at most 2 GiB per call

/// `write(bytes, size)` until all is written; one that writes nothing would go on for ever.
template <class Write>
int write_all(const char* bytes, std::size_t size, const Write& write) {
  while (size > 0) {
    const ssize_t written = uninterrupted([&] { return write(bytes, std::min(size, kLargest)); });
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
  return 0;
}

}  // namespace

int append_fully(int file, const void* data, std::size_t size) {
  return write_all(static_cast<const char*>(data), size,
                   [&](const char* bytes, std::size_t n) { return ::write(file, bytes, n); });
}

int write_fully(int file, const void* data, std::size_t size, std::uint64_t position) {
  const auto* first = static_cast<const char*>(data);
  return write_all(first, size, [&](const char* bytes, std::size_t n) {
    return ::pwrite(file, bytes, n, static_cast<off_t>(position) + (bytes - first));
  });
}

int read_fully(int file, void* out, std::size_t size, std::uint64_t position, std::size_t& got) {
  got = 0;
  while (got < size) {
    const ssize_t n = uninterrupted([&] {
      return ::pread(file, static_cast<char*>(out) + got, std::min(size - got, kLargest),
                     static_cast<off_t>(position + got));
    });
    if (n < 0) return errno;
    if (n == 0) return 0;
    got += static_cast<std::size_t>(n);
  }
  return 0;
}

int read_all(const std::string& path, std::string& out) {
  constexpr std::size_t kPiece = 1 << 20;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return errno;
  out.clear();
  for (std::size_t done = 0;;) {
    out.resize(done + kPiece);
    const ssize_t n = uninterrupted([&] { return ::read(file.get(), &out[done], kPiece); });
    if (n < 0) return errno;
    out.resize(done += static_cast<std::size_t>(n));
    if (n == 0) return 0;
  }
}

int cut_file(int file, std::uint64_t size) {
  return error_of([&] { return ::ftruncate(file, static_cast<off_t>(size)); });
}

int sync_file(int file) {
  return error_of([&] { return ::fsync(file); });
}

int sync_file(const std::string& path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file ? sync_file(file.get()) : errno;
}

int sync_folder(const std::string& path) {
  const FileDescriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const int error = folder ? sync_file(folder.get()) : errno;
  return error == EIO || error == ENOSPC || error == EDQUOT ? error : 0;
}

int close_file(FileDescriptor& file) {
  const int id = file.release();
  // whatever is returned the descriptor is gone; an interrupted call has only not waited
  return id < 0 || ::close(id) == 0 || errno == EINTR ? 0 : errno;
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

void check_io(int error, const std::string& path, const char* what) {
  if (error != 0)
    throw Error(ErrorCode::resources, path + ": " + what + " (" + std::strerror(error) + ")");
}

}  // namespace bem
