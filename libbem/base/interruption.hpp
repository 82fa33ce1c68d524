#pragma once

#include <functional>

namespace bem {

/// Installs what check_interruption() calls: it may throw to abandon the work, as a command-line
/// tool does after Ctrl-C. Empty: nothing. Not to be changed while a parallel_for runs.
void set_interruption_check(std::function<void()> check);

/// What work that may take long calls at least every tenth of a second, on any thread: each body of
/// a parallel_for, each iteration of a solver, each pass over a mesh. Throws what the installed
/// check throws; costs a few nanoseconds.
void check_interruption();

}  // namespace bem
