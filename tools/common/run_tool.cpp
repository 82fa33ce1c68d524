#include "base/error.hpp"
#include "common/cli.hpp"

#include <iostream>
#include <new>

namespace bem {

std::string version_text() {
  return std::string("bem ") + BEM_VERSION;
}

int run_tool(Log& log, const std::function<int()>& body) {
  try {
    const int code = body();
    if (!std::cout.flush()) throw Error(ErrorCode::resources, "standard output cannot be written");
    return code;
  } catch (const Error& e) {
    log.error(e.what());
    return static_cast<int>(e.code());
  } catch (const Interrupted& e) {
    log.error(e.what());
    return 128 + e.signal();
  } catch (const std::bad_alloc&) {
    log.error("not enough memory");
    return static_cast<int>(ErrorCode::resources);
  } catch (const std::exception& e) {
    log.error(std::string("internal error: ") + e.what());
    return static_cast<int>(ErrorCode::internal);
  }
}

}  // namespace bem
