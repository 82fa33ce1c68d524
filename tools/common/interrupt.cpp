#include "common/interrupt.hpp"

#include <atomic>
#include <chrono>
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
    action.sa_flags = static_cast<int>(SA_RESETHAND);  // what waits for a pipe ends
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

int pending_interrupt() {
  return pending;
}

void check_overdue_interrupt() {
  using Clock = std::chrono::steady_clock;
  constexpr Clock::duration kGrace = std::chrono::milliseconds(500);
  static std::atomic<Clock::rep> noticed{0};
  const int signal = pending;
  if (signal == 0) return;
  const Clock::rep now = Clock::now().time_since_epoch().count();
  Clock::rep first = 0;
  if (noticed.compare_exchange_strong(first, now)) return;
  if (now - first > kGrace.count()) throw Interrupted(signal);
}

void check_interrupt() {
  if (const int signal = pending) throw Interrupted(signal);
}

}  // namespace bem
