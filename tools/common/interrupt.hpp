#pragma once

#include <stdexcept>
#include <string>

namespace bem {

/// Thrown by check_interrupt(); run_tool turns it into the exit code 128 + signal.
class Interrupted : public std::runtime_error {
 public:
  /// `state`: what is left of the work, for the message.
  explicit Interrupted(int signal, const std::string& state = "");
  int signal() const { return signal_; }

 private:
  int signal_;
};

/// From here on the first SIGINT or SIGTERM only sets a flag; a second one ends the process at
/// once.
void catch_interrupts();

/// The signal that arrived, 0 if none. May be called from any thread.
int pending_interrupt();

/// Throws Interrupted if a signal arrived: what long work calls now and then.
void check_interrupt();

/// Throws Interrupted if a signal was noticed here more than half a second ago: what work calls
/// that had better come to its end. May be called from any thread.
void check_overdue_interrupt();

}  // namespace bem
