#include "files/disk_reserve.hpp"

#include "files/file_io.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

namespace bem {
namespace {

std::uint64_t size_of(const FileDescriptor& file) {
  struct stat status {};
  return ::fstat(file.get(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

/// What the process may write at most; fallocate does not look at it.
std::uint64_t size_limit() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_FSIZE, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

/// 0, or the error that says that there is no room.
int reserve(const FileDescriptor& file, std::uint64_t from, std::uint64_t bytes) {
  if (from + bytes > size_limit()) return EFBIG;
  if (::fallocate(file.get(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from),
                  static_cast<off_t>(bytes)) == 0)
    return 0;
  if (errno == EINTR) return reserve(file, from, bytes);
  return errno == ENOSPC || errno == EDQUOT || errno == EFBIG ? errno : 0;
}

}  // namespace

DiskReserve::DiskReserve(const std::string& path) : DiskReserve(path, path) {}

DiskReserve::DiskReserve(const std::string& path, std::string name)
    : path_(std::move(name)), file_(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW)) {
  check_io(file_ ? 0 : errno, path_);
}

void DiskReserve::ensure(std::uint64_t bytes) {
  constexpr std::uint64_t kAhead = 1 << 20;  // so that small additions rarely ask
  const std::uint64_t size = size_of(file_);
  if (size + bytes <= end_) return;
  const std::uint64_t ahead = std::max(2 * bytes, kAhead);
  if (reserve(file_, size, ahead) == 0) {
    end_ = size + ahead;
    return;
  }
  check_io(reserve(file_, size, bytes), path_, "cannot grow");
  end_ = size + bytes;
}

void DiskReserve::release() {
  if (!file_) return;
  // cutting a file at its own end frees what is reserved beyond; if that fails it is only space
  if (end_ > size_of(file_))
    static_cast<void>(::ftruncate(file_.get(), static_cast<off_t>(size_of(file_))) == 0);
  file_ = FileDescriptor();
}

}  // namespace bem
