#pragma once

#include "common/interrupt.hpp"
#include "common/log.hpp"
#include "common/measure.hpp"
#include "common/progress_bar.hpp"
#include "common/version.hpp"

#include <functional>

// What the command-line tools share. The library prints nothing and never exits; this does.

namespace bem {

/// Runs the body of a tool and returns the exit code of the process: the body's own, the code of a
/// bem::Error, 6 when memory runs out, 128 + the signal's number for Interrupted, 1 for any other
/// exception. A failure is reported as one `error: ...` line (and to the log file if there is one).
int run_tool(Log& log, const std::function<int()>& body);

}  // namespace bem
