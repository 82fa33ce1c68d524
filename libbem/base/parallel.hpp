#pragma once

#include <cstddef>
#include <functional>

namespace bem {

/// Limits the worker threads of every later parallel_for (n >= 1).
void set_thread_count(int n);

/// Number of worker threads in use.
int thread_count();

/// Calls body(i) once for each i in [0, n), on all worker threads, in no particular order.
/// Results must not depend on the order: a body writes only what belongs to its own index, and
/// reductions are summed by the caller in index order. Exceptions of a body reach the caller.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// What every later parallel_for calls before each body, on any of its threads: it may throw to
/// abandon the work, as a command-line tool does after Ctrl-C. Empty: nothing. Not to be changed
/// while a parallel_for runs.
void set_interruption_check(std::function<void()> check);

}  // namespace bem
