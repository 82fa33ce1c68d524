#include "base/pending_file.hpp"

#include "base/error.hpp"
#include "base/file_descriptor.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>

namespace bem {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what, int cause) {
  throw Error(ErrorCode::resources, path + ": " + what + " (" + std::strerror(cause) + ")");
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

}  // namespace

PendingFile::PendingFile(const std::string& path)
    : path_(path), temporary_(path + ".partial-" + std::to_string(getpid())) {
  const FileDescriptor file(
      ::open(temporary_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666));
  if (!file) fail(path, "cannot be written", errno);
}

PendingFile::~PendingFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void PendingFile::commit() {
  {
    const FileDescriptor file(::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file || ::fsync(file.get()) != 0) fail(path_, "cannot be written", errno);
  }
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
  temporary_.clear();
  const FileDescriptor folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder) ::fsync(folder.get());  // not every file system can; the file itself is complete
}

void check_free_space(const std::string& path, double bytes) {
  std::error_code code;
  const auto space = std::filesystem::space(folder_of(path), code);
  if (code || static_cast<double>(space.available) >= bytes) return;
  const auto megabytes = [](double b) {
    return std::to_string(static_cast<long long>(b / 1e6) + 1);
  };
  throw Error(ErrorCode::resources, path + ": needs " + megabytes(bytes) + " MB, but only " +
                                        megabytes(static_cast<double>(space.available)) +
                                        " MB are free there; make room or write elsewhere");
}

}  // namespace bem
