#include "files/temporary_file.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>

namespace bem {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryMark = ".partial-", kDigits = "0123456789abcdef";
constexpr std::size_t kLength = 16;  // of the random part

std::string random_part() {
  std::array<unsigned char, kLength / 2> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw Error(ErrorCode::resources, "the system has no random numbers for names of files");
  std::string text;
  for (const unsigned byte : bytes) text += {kDigits[byte >> 4], kDigits[byte & 15]};
  return text;
}

/// Is the file one that somebody removed between its creation and our lock?
bool is_removed(const FileDescriptor& file) {
  struct stat status {};
  return ::fstat(file.get(), &status) == 0 && status.st_nlink == 0;
}

bool is_regular(const FileDescriptor& file) {
  struct stat status {};
  return ::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode);
}

/// File systems know one of the two ways, or neither: then the look before is all there is.
int rename_to_free_name(const char* from, const char* to) {
  if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  if (::link(from, to) == 0) return ::unlink(from) == 0 ? 0 : errno;
  if (errno != EPERM && errno != EOPNOTSUPP && errno != ENOSYS) return errno;
  struct stat status {};
  if (::lstat(to, &status) == 0) return EEXIST;
  return std::rename(from, to) == 0 ? 0 : errno;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& final_path) : final_path_(final_path) {
  do {
    path_ = final_path + std::string(kTemporaryMark) + random_part();
    file_ = FileDescriptor(
        ::open(path_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_RDWR | O_CLOEXEC, 0666));
    if (!file_ && errno == EEXIST) continue;
    check_io(file_ ? 0 : errno, final_path_);
    // Waits for one who looks whether the file is abandoned; without locks nobody takes it for
    // that.
    while (::flock(file_.get(), LOCK_EX) != 0 && errno == EINTR) {
    }
  } while (!file_ || is_removed(file_));
}

TemporaryFile::~TemporaryFile() {
  if (file_) ::unlink(path_.c_str());
}

void TemporaryFile::append(std::string_view bytes) {
  check_io(append_fully(file_.get(), bytes.data(), bytes.size()), final_path_);
}

void TemporaryFile::sync() {
  check_io(sync_file(file_.get()), final_path_);
}

void TemporaryFile::publish(ExistingFile existing) {
  // Failed writes are told of before the name is given, and the lock is held until then.
  FileDescriptor other(::fcntl(file_.get(), F_DUPFD_CLOEXEC, 0));
  check_io(other ? close_file(other) : errno, final_path_);
  if (existing == ExistingFile::replace) {
    check_io(std::rename(path_.c_str(), final_path_.c_str()) == 0 ? 0 : errno, final_path_,
             "cannot be replaced");
  } else if (const int error = rename_to_free_name(path_.c_str(), final_path_.c_str())) {
    if (error == EEXIST)
      throw Error(ErrorCode::usage, final_path_ +
                                        ": exists now, written by somebody else in the meantime; "
                                        "use --force to overwrite it");
    check_io(error, final_path_);
  }
  file_ = FileDescriptor();
}

std::string_view TemporaryFile::final_name(std::string_view name) {
  if (name.size() <= kTemporaryMark.size() + kLength) return name;
  const std::string_view start = name.substr(0, name.size() - kLength);
  const bool temporary = start.substr(start.size() - kTemporaryMark.size()) == kTemporaryMark &&
                         name.find_first_not_of(kDigits, start.size()) == std::string_view::npos;
  return temporary ? start.substr(0, start.size() - kTemporaryMark.size()) : name;
}

void TemporaryFile::remove_abandoned(const std::string& final_path) {
  const std::string wanted = fs::path(final_path).filename().string();
  std::error_code ended;
  for (fs::directory_iterator it(folder_of(final_path), ended), end; !ended && it != end;
       it.increment(ended)) {
    const std::string name = it->path().filename().string();
    if (name == wanted || final_name(name) != wanted) continue;
    const FileDescriptor file(
        ::open(it->path().c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (file && is_regular(file) && ::flock(file.get(), LOCK_EX | LOCK_NB) == 0)
      ::unlink(it->path().c_str());
  }
}

}  // namespace bem
