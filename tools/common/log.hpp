#pragma once

#include <fstream>
#include <mutex>
#include <string>

namespace bem {

enum class Verbosity { quiet, normal, verbose };

/// Messages of a tool: plain lines on stderr, and all of them in a log file where one is asked for.
/// quiet shows warnings and errors, normal also `info:`, verbose also `detail:`. Thread safe.
class Log {
 public:
  void set_verbosity(Verbosity verbosity) { verbosity_ = verbosity; }
  Verbosity verbosity() const { return verbosity_; }
  /// Is there nothing of this name, or a file that a log has written, or a device?
  static bool is_log(const std::string& path);
  /// Overwrites `path`; throws ErrorCode::resources if it cannot be written.
  void open_file(const std::string& path);

  void error(const std::string& text);
  void warning(const std::string& text);
  void info(const std::string& text);
  void detail(const std::string& text);

  /// Whether status lines are shown: on a terminal, unless quiet.
  bool shows_status() const;
  /// Replaces the one line at the bottom of the terminal that is not kept; empty removes it.
  void set_status(const std::string& text);

 private:
  void print(const char* kind, const std::string& message, bool shown);
  void erase_status();

  std::mutex mutex_;
  Verbosity verbosity_ = Verbosity::normal;
  std::ofstream file_;
  std::string status_;
};

}  // namespace bem
