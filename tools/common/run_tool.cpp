#include "base/error.hpp"
#include "common/cli.hpp"
#include "common/memory.hpp"

#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

namespace bem {

namespace {

int exit_code(ErrorCode code) {
  return static_cast<int>(code);
}

/// Reports the exception that is being handled.
int report(Log& log) {
  release_memory_reserve();
  try {
    throw;
  } catch (const Error& e) {
    if (const int signal = pending_interrupt()) {  // which is why a file cannot be opened
      log.error(Interrupted(signal).what());
      return 128 + signal;
    }
    log.error(e.what());
    return exit_code(e.code());
  } catch (const Interrupted& e) {
    log.error(e.what());
    return 128 + e.signal();
  } catch (const std::bad_alloc&) {
    log.error("not enough memory");
    return exit_code(ErrorCode::resources);
  } catch (const std::length_error&) {
    log.error("not enough memory");
    return exit_code(ErrorCode::resources);
  } catch (const std::system_error& e) {
    log.error(std::string("the system has failed: ") + e.what());
    return exit_code(ErrorCode::resources);
  } catch (const std::exception& e) {
    log.error(std::string("internal error: ") + e.what());
    return exit_code(ErrorCode::internal);
  }
}

}  // namespace

int run_tool(Log& log, const std::function<int()>& body) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that is too large is a failed write
  try {
    guard_memory();
    try {
      const int code = body();
      if (!std::cout.flush())
        throw Error(ErrorCode::resources, "standard output cannot be written");
      return code;
    } catch (...) {
      return report(log);
    }
  } catch (const std::bad_alloc&) {  // of the report
    end_without_memory();
  }
}

}  // namespace bem
