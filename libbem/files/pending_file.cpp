#include "files/pending_file.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"

#include <cerrno>
#include <filesystem>

#include <fcntl.h>

namespace bem {

namespace fs = std::filesystem;

PendingFile::PendingFile(const std::string& path) : path_(path) {
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  if (fs::is_directory(status)) check_io(EISDIR, path);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    device_ = FileDescriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    check_io(device_ ? 0 : errno, path);
  } else {
    TemporaryFile::remove_abandoned(path);
    temporary_.emplace(path);
  }
}

void PendingFile::append(std::string_view bytes) {
  if (temporary_)
    temporary_->append(bytes);
  else
    check_io(append_fully(device_.get(), bytes.data(), bytes.size()), path_);
}

void PendingFile::commit(ExistingFile existing) {
  if (!temporary_) return check_io(close_file(device_), path_);
  temporary_->sync();
  temporary_->publish(existing);
  check_io(sync_folder(folder_of(path_)), path_);
}

void PendingFile::commit(const std::string& contents) {
  append(contents);
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
