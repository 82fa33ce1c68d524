#include "output/growing_file.hpp"

#include "files/file_io.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>

namespace bem {

GrowingFile::GrowingFile(const std::string& path)
    : path_(path), file_(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW)), reserve_(path) {
  struct stat status {};
  check_io(file_ && ::fstat(file_.get(), &status) == 0 ? 0 : errno, path);
  size_ = static_cast<std::uint64_t>(status.st_size);
}

void GrowingFile::write(std::uint64_t position, std::string_view bytes) {
  reserve_.ensure(bytes.size());
  std::string old(std::min<std::uint64_t>(bytes.size(), size_ - position), '\0');
  std::size_t got = 0;
  check_io(read_fully(file_.get(), old.data(), old.size(), position, got), path_);
  if (const int error = write_fully(file_.get(), bytes.data(), bytes.size(), position)) {
    if (write_fully(file_.get(), old.data(), old.size(), position) == 0)
      cut_file(file_.get(), size_);
    check_io(error, path_);
  }
  size_ = std::max(size_, position + bytes.size());
}

void GrowingFile::truncate(std::uint64_t size) {
  check_io(cut_file(file_.get(), size), path_, "cannot be cut");
  size_ = size;
}

void GrowingFile::sync() {
  check_io(sync_file(file_.get()), path_);
}

void GrowingFile::close() {
  reserve_.release();
  check_io(close_file(file_), path_);
}

}  // namespace bem
