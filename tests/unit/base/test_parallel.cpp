#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"

#include <atomic>
#include <vector>

#include <catch2/catch.hpp>

TEST_CASE("every index is visited exactly once, whatever the number of threads") {
  for (int threads : {1, 2, 5}) {
    bem::set_thread_count(threads);
    std::vector<std::atomic<int>> visits(1000);
    bem::parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& v : visits) REQUIRE(v == 1);
  }
}

TEST_CASE("an exception of a parallel body reaches the caller") {
  for (int threads : {1, 3}) {
    bem::set_thread_count(threads);
    REQUIRE_THROWS_AS(bem::parallel_for(100,
                                        [](std::size_t i) {
                                          if (i == 37)
                                            throw bem::Error(bem::ErrorCode::numerical, "37");
                                        }),
                      bem::Error);
  }
}

TEST_CASE("the interruption check runs before every body and can abandon the work") {
  for (int threads : {1, 3}) {
    bem::set_thread_count(threads);
    std::atomic<int> checks{0}, bodies{0};
    bem::set_interruption_check([&] {
      if (++checks > 5) throw bem::Error(bem::ErrorCode::numerical, "stop");
    });
    CHECK_NOTHROW(bem::parallel_for(5, [&](std::size_t) { ++bodies; }));
    CHECK(bodies == 5);
    CHECK_THROWS_AS(bem::parallel_for(100, [&](std::size_t) { ++bodies; }), bem::Error);
    CHECK(bodies == 5);
    bem::set_interruption_check(nullptr);
    CHECK_NOTHROW(bem::parallel_for(100, [](std::size_t) {}));
  }
}
