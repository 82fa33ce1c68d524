#include "common/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <initializer_list>

#include <signal.h>

namespace bem {
namespace {

std::atomic<int> pending{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not wait for a lock");

void remember(int signal) {
  pending = signal;
}

}  // namespace

Interrupted::Interrupted(int signal, const std::string& state)
    : std::runtime_error(
          std::string(signal == SIGTERM ? "interrupted (SIGTERM)" : "interrupted (SIGINT)") +
          state),
      signal_(signal) {}

void catch_interrupts() {
  for (int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    action.sa_handler = remember;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

int pending_interrupt() {
  return pending;
}

void check_interrupt() {
  if (const int signal = pending) throw Interrupted(signal);
}

}  // namespace bem
