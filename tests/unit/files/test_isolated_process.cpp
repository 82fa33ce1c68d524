#include "base/error.hpp"
#include "base/interruption.hpp"
#include "files/isolated_process.hpp"

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

using namespace bem;

TEST_CASE("work in a child process returns its bytes") {
  std::string bytes(3000000, 'x');  // more than a pipe holds
  bytes[1234567] = '\0';
  const IsolatedResult result = run_isolated([&] { return bytes; }, {});
  CHECK(result.finished);
  CHECK(result.output == bytes);
}

TEST_CASE("a crash of the child is reported and survived") {
  const IsolatedResult aborted = run_isolated([]() -> std::string { std::abort(); }, {});
  CHECK_FALSE(aborted.finished);
  CHECK(aborted.failure == "Aborted");
  const auto kill = []() -> std::string {
    std::raise(SIGSEGV);
    return {};
  };
  CHECK_FALSE(run_isolated(kill, {}).finished);
}

TEST_CASE("an error that the work throws is thrown in the parent") {
  const auto refuse = []() -> std::string { throw Error(ErrorCode::archive, "not like this"); };
  try {
    run_isolated(refuse, {});
    FAIL("the error is lost");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::archive);
    CHECK(error.what() == std::string("not like this"));
  }
}

TEST_CASE("a child that never ends is stopped, whether it computes or sleeps") {
  const auto spin = []() -> std::string {
    for (volatile int i = 0;; i = i + 1) {
    }
  };
  const auto sleep = []() -> std::string {
    for (;;) pause();
  };
  IsolatedLimits of_cpu, of_wall;
  of_cpu.cpu_seconds = 1;
  of_wall.wall_seconds = 0.3;
  for (const IsolatedResult& result : {run_isolated(spin, of_cpu), run_isolated(sleep, of_wall)}) {
    CHECK_FALSE(result.finished);
    CHECK_THAT(result.failure, Catch::Matchers::Contains("too much time"));
  }
}

#ifndef __SANITIZE_ADDRESS__  // which takes address space of its own, and ends where there is none
TEST_CASE("a child gets the memory that it is allowed and no more") {
  const auto allocate = []() -> std::string {
    try {
      return std::to_string(std::string(std::size_t{300} << 20, 'x').size() >> 20);
    } catch (const std::bad_alloc&) {
      return "none";
    }
  };
  IsolatedLimits limits;
  limits.memory = std::size_t{400} << 20;
  CHECK(run_isolated(allocate, limits).output == "300");
  limits.memory = std::size_t{200} << 20;
  CHECK(run_isolated(allocate, limits).output == "none");
}
#endif

TEST_CASE("an interruption is passed on at once and ends the child") {
  int calls = 0;
  set_interruption_check([&] {
    if (++calls > 2) throw std::runtime_error("stop");
  });
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const auto hold = [&]() -> std::string {  // the pipe stays open as long as the child lives
    for (;;) pause();
  };
  CHECK_THROWS_WITH(run_isolated(hold, {}), "stop");
  set_interruption_check(nullptr);
  close(ends[1]);
  char byte = 0;
  CHECK(read(ends[0], &byte, 1) == 0);
  close(ends[0]);
}

TEST_CASE("a child ends with its parent, however that ends") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t parent = fork();
  if (parent == 0) {
    close(ends[0]);
    run_isolated(
        [&]() -> std::string {
          if (write(ends[1], "x", 1) != 1) std::abort();
          for (;;) pause();
        },
        {});
    _exit(0);
  }
  close(ends[1]);
  char byte = 0;
  CHECK(read(ends[0], &byte, 1) == 1);  // the child runs
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  CHECK(read(ends[0], &byte, 1) == 0);  // nobody has the other end any more
  close(ends[0]);
}
