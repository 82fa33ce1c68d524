#pragma once

#include <functional>
#include <string>

namespace bem {

/// What became of a piece of work in a process of its own.
struct IsolatedResult {
  bool finished = false;  ///< the work returned; otherwise it crashed or ran out of time
  std::string output;     ///< what it returned
  std::string failure;    ///< why it did not finish, e.g. "Segmentation fault"
};

/// Runs `work` in a child process and returns the bytes that it returned, so that third-party code
/// which aborts, crashes or hangs on damaged input cannot take this process along. The child prints
/// nothing, leaves no core file and is stopped after `cpu_seconds` of processor time. `work` must
/// not throw, must not start threads, and must not need locks that other threads of this process
/// hold. Throws ErrorCode::resources if no process can be started.
IsolatedResult run_isolated(const std::function<std::string()>& work, int cpu_seconds);

}  // namespace bem
