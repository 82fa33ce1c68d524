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
/// check_interruption() (base/interruption.hpp) is called before each body.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

}  // namespace bem
