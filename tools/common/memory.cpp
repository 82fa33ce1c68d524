#include "common/memory.hpp"

#include "base/error.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <new>
#include <string_view>

#include <unistd.h>

namespace bem {
namespace {

std::unique_ptr<char[]>& reserve() {
  static std::unique_ptr<char[]> memory;
  return memory;
}

std::atomic<bool> guarded{false}, told{false};

void say(std::string_view text) {
  static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()) < 0);
}

[[noreturn]] void end_without_catch() {
  try {
    if (const std::exception_ptr e = std::current_exception()) std::rethrow_exception(e);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::exception& e) {
    say("error: internal error: ");
    say(e.what());
    say("\n");
  } catch (...) {
  }
  _exit(static_cast<int>(ErrorCode::internal));
}

}  // namespace

void errors_are_told() {
  told = true;
}

void end_without_memory() {
  if (!told) say("error: not enough memory\n");
  _exit(static_cast<int>(ErrorCode::resources));
}

void guard_memory() {
  constexpr std::size_t kForMessages = 1 << 18;
  reserve() = std::make_unique<char[]>(kForMessages);
  std::set_terminate(end_without_catch);
  guarded = true;
}

bool is_guarded() {
  return guarded;
}

void release_memory_reserve() {
  reserve().reset();
}

}  // namespace bem
