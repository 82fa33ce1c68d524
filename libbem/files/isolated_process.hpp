#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace bem {

/// What work in a process of its own may take.
struct IsolatedLimits {
  int cpu_seconds = 10;
  double wall_seconds = 100;
  std::size_t memory = std::size_t{1} << 30;  ///< beyond what this process has [B]
};

/// What became of a piece of work in a process of its own.
struct IsolatedResult {
  bool finished = false;  ///< the work returned; otherwise it crashed or ran out of time
  std::string output;     ///< what it returned
  std::string failure;    ///< why it did not finish, e.g. "Segmentation fault"
};

/// Runs `work` in a child process and returns the bytes that it returned, so that third-party code
/// which aborts, crashes or hangs on damaged input cannot take this process along. The child prints
/// nothing, leaves no core file, is stopped at the limits, and ends with this process, however that
/// ends. An Error that `work` throws, with a text that is not empty, is thrown here; it may
/// throw std::bad_alloc (at an allocation beyond the limit) and nothing else. It must not start
/// threads, and must not need locks that other threads of this process hold.
///
/// While it waits it calls check_interruption() (base/interruption.hpp) twenty times a second: what
/// that throws ends the child and is passed on. Throws ErrorCode::resources if no process can be
/// started, and if the child gets no memory although it has taken less than half of its limit: then
/// it is the system that has none.
IsolatedResult run_isolated(const std::function<std::string()>& work, const IsolatedLimits& limits);

}  // namespace bem
