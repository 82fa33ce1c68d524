#include "mesh/isolated_process.hpp"
#include "mesh_test.hpp"

#include <csignal>
#include <cstdlib>

using namespace bem;

TEST_CASE("work in a child process returns its bytes") {
  std::string bytes(3000000, 'x');  // more than a pipe holds
  bytes[1234567] = '\0';
  const IsolatedResult result = run_isolated([&] { return bytes; }, 10);
  CHECK(result.finished);
  CHECK(result.output == bytes);
}

TEST_CASE("a crash of the child is reported and survived") {
  const IsolatedResult aborted = run_isolated([]() -> std::string { std::abort(); }, 10);
  CHECK_FALSE(aborted.finished);
  CHECK(aborted.failure == "Aborted");
  const auto kill = []() -> std::string {
    std::raise(SIGSEGV);
    return {};
  };
  CHECK_FALSE(run_isolated(kill, 10).finished);
}

TEST_CASE("a child that never ends is stopped") {
  const auto spin = []() -> std::string {
    for (volatile int i = 0;; i = i + 1) {
    }
  };
  const IsolatedResult result = run_isolated(spin, 1);
  CHECK_FALSE(result.finished);
  CHECK_THAT(result.failure, Catch::Matchers::Contains("too much time"));
}
