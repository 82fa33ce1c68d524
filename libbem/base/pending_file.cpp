#include "base/pending_file.hpp"

#include "base/error.hpp"
#include "base/file_descriptor.hpp"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/types.h>

namespace bem {
namespace {

namespace fs = std::filesystem;

const std::string kMark = ".partial-";  ///< before the number of the process that writes

[[noreturn]] void fail(const std::string& path, const std::string& what, int cause) {
  throw Error(ErrorCode::resources, path + ": " + what + " (" + std::strerror(cause) + ")");
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool is_device_or_pipe(const std::string& path) {
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// The process that writes a temporary file of this name, 0 if it is none.
pid_t writer_of(const std::string& name, const std::string& final_name) {
  const std::string start = final_name + kMark;
  if (name.compare(0, start.size(), start) != 0) return 0;
  pid_t process = 0;
  const char* last = name.data() + name.size();
  const auto [end, code] = std::from_chars(name.data() + start.size(), last, process);
  return code == std::errc() && end == last && process > 0 ? process : 0;
}

/// Removes the temporary files of processes that are no more.
void remove_abandoned(const std::string& path) {
  const std::string final_name = fs::path(path).filename().string();
  std::error_code ended;
  for (fs::directory_iterator it(folder_of(path), ended), end; !ended && it != end;
       it.increment(ended)) {
    const pid_t writer = writer_of(it->path().filename().string(), final_name);
    if (writer > 0 && ::kill(writer, 0) != 0 && errno == ESRCH) ::unlink(it->path().c_str());
  }
}

}  // namespace

PendingFile::PendingFile(const std::string& path) : path_(path) {
  const bool direct = is_device_or_pipe(path);
  temporary_ = direct ? path : path + kMark + std::to_string(getpid());
  if (!direct) remove_abandoned(path);
  const FileDescriptor file(
      ::open(temporary_.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0666));
  if (!file) fail(path, "cannot be written", errno);
  exists_ = !direct;
}

PendingFile::~PendingFile() {
  if (exists_) ::unlink(temporary_.c_str());
}

bool PendingFile::is_temporary(const std::string& name, const std::string& final_name) {
  return writer_of(name, final_name) > 0;
}

void PendingFile::commit() {
  if (!exists_) return;
  {
    const FileDescriptor file(::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file || ::fsync(file.get()) != 0) fail(path_, "cannot be written", errno);
  }
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
  exists_ = false;
  const FileDescriptor folder(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder) ::fsync(folder.get());  // not every file system can; the file itself is complete
}

void PendingFile::commit(const std::string& contents) {
  std::ofstream file(temporary_, std::ios::binary);
  errno = 0;
  file << contents << std::flush;
  if (!file) fail(path_, "cannot be written", errno);
  file.close();
  commit();
}

void check_free_space(const std::string& path, double bytes) {
  std::error_code code;
  const auto space = fs::space(folder_of(path), code);
  if (code || static_cast<double>(space.available) >= bytes) return;
  const auto megabytes = [](double b) {
    return std::to_string(static_cast<long long>(b / 1e6) + 1);
  };
  throw Error(ErrorCode::resources, path + ": needs " + megabytes(bytes) + " MB, but only " +
                                        megabytes(static_cast<double>(space.available)) +
                                        " MB are free there; make room or write elsewhere");
}

}  // namespace bem
