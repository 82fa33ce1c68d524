#include "base/parallel.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"

#include <algorithm>
#include <memory>
#include <thread>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace bem {
namespace {

struct ThreadLimit {
  int count = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::unique_ptr<tbb::global_control> control;
};

ThreadLimit& thread_limit() {
  static ThreadLimit limit;
  return limit;
}

}  // namespace

void set_thread_count(int n) {
  require(n >= 1, "thread count is at least 1");
  ThreadLimit& limit = thread_limit();
  limit.control.reset();
  limit.control = std::make_unique<tbb::global_control>(
      tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n));
  limit.count = n;
}

int thread_count() {
  return thread_limit().count;
}

void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) {
  const auto run = [&](std::size_t i) {
    check_interruption();
    body(i);
  };
  if (n == 1 || thread_count() == 1) {
    for (std::size_t i = 0; i < n; ++i) run(i);
    return;
  }
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, n, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) run(i);
      },
      tbb::simple_partitioner());
}

}  // namespace bem
