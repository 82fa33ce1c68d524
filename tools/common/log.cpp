#include "common/log.hpp"

#include "base/error.hpp"
#include "common/memory.hpp"
#include "scene/location.hpp"

#include <filesystem>
#include <iostream>
#include <string_view>

#include <unistd.h>

namespace bem {

namespace {

constexpr const char* kError = "error: ";

}  // namespace

bool Log::is_log(const std::string& path) {
  if (path.empty()) return false;
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return true;
  std::string start(9, '\0');  // the length of the longest of these
  std::ifstream file(path);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  for (const std::string_view kind : {"error: ", "warning: ", "info: ", "detail: "})
    if (start.compare(0, kind.size(), kind) == 0) return true;
  return start.empty();
}

void Log::open_file(const std::string& path) {
  file_.open(path, std::ios::trunc);
  if (!file_) throw Error(ErrorCode::resources, path + ": the log file cannot be written");
}

void Log::error(const std::string& text) {
  print(kError, text, true);
}

void Log::warning(const std::string& text) {
  print("warning: ", text, true);
}

void Log::info(const std::string& text) {
  print("info: ", text, verbosity_ != Verbosity::quiet);
}

void Log::detail(const std::string& text) {
  print("detail: ", text, verbosity_ == Verbosity::verbose);
}

void Log::print(const char* kind, const std::string& message, bool shown) {
  constexpr std::size_t kLongest = 10000;
  const std::string text = printable(message, kLongest);  // names of files may hold anything
  const std::lock_guard lock(mutex_);
  if (shown) {
    erase_status();
    std::cerr << kind << text << "\n" << status_ << std::flush;
    if (kind == kError) errors_are_told();
  }
  if (file_.is_open() && !(file_ << kind << text << std::endl)) {
    file_.close();
    erase_status();
    std::cerr << "warning: the log file cannot be written any more\n" << status_ << std::flush;
  }
}

bool Log::shows_status() const {
  static const bool terminal = isatty(STDERR_FILENO) == 1;
  return terminal && verbosity_ != Verbosity::quiet;
}

void Log::set_status(const std::string& text) {
  if (!shows_status()) return;
  const std::lock_guard lock(mutex_);
  erase_status();
  status_ = text;
  std::cerr << status_ << std::flush;
}

void Log::erase_status() {
  if (!status_.empty()) std::cerr << "\r\033[K";
}

}  // namespace bem
