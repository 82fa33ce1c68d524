#include "base/finite.hpp"
#include "base/narrow.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace bem;

TEMPLATE_TEST_CASE("one number that is not finite is found wherever it is", "", float, double) {
  using Limits = std::numeric_limits<TestType>;
  const std::size_t count = GENERATE(1, 7, 33, 200001);
  std::vector<TestType> numbers(count, Limits::max());
  CHECK(all_finite(numbers.data(), 0));
  CHECK(all_finite(numbers.data(), count));
  for (TestType bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()})
    for (std::size_t at : {std::size_t(0), count / 2, count - 1}) {
      numbers[at] = bad;
      CHECK_FALSE(all_finite(numbers.data(), count));
      numbers[at] = -Limits::max();
    }
  CHECK(all_finite(numbers.data(), count));
}

TEST_CASE("numbers are narrowed or refused, never cut") {
  const auto narrowed = [](std::int32_t n) {
    return narrow<std::uint16_t>(n, ErrorCode::archive, "an extent");
  };
  CHECK(narrowed(0) == 0);
  CHECK(narrowed(65535) == 65535);
  for (std::int32_t n : {-1, 65536, 65537, -65536, 1 << 30}) {
    CAPTURE(n);
    CHECK_THROWS_WITH(narrowed(n), "an extent is out of range");
  }
  CHECK_THROWS_AS(narrow<std::int32_t>(std::uint64_t(1) << 63, ErrorCode::archive, "n"), Error);
  CHECK_THROWS_AS(narrow<std::uint64_t>(std::int64_t(-1), ErrorCode::archive, "n"), Error);
}
