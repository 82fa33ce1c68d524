#include "output/growing_file.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>

namespace bem {

GrowingFile::GrowingFile(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)), reserve_(path) {
  if (!file_)
    throw Error(ErrorCode::resources, path + ": cannot be written (" + std::strerror(errno) + ")");
}

void GrowingFile::write(std::uint64_t position, std::string_view bytes) {
  reserve_.ensure(bytes.size());
  while (!bytes.empty()) {
    const ssize_t written =
        ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(position));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0)
      throw Error(ErrorCode::resources,
                  path_ + ": cannot be written (" + std::strerror(errno) + ")");
    bytes.remove_prefix(static_cast<std::size_t>(written));
    position += static_cast<std::uint64_t>(written);
  }
}

void GrowingFile::truncate(std::uint64_t size) {
  if (::ftruncate(file_.get(), static_cast<off_t>(size)) != 0)
    throw Error(ErrorCode::resources, path_ + ": cannot be cut (" + std::strerror(errno) + ")");
}

void GrowingFile::close() {
  reserve_.release();
  file_ = FileDescriptor();
}

}  // namespace bem
