#include "mesh/isolated_process.hpp"

#include "base/error.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bem {
namespace {

constexpr int kCrashed = 99;

void set_limit(int which, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(static_cast<decltype(RLIMIT_CPU)>(which), &limit);
}

void silence(int descriptor) {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, descriptor);
}

bool write_all(int descriptor, const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = write(descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

[[noreturn]] void run_child(const std::function<std::string()>& work, int cpu_seconds, int pipe) {
  for (int signal : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE})
    std::signal(signal, SIG_DFL);
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, static_cast<rlim_t>(cpu_seconds));
  silence(STDOUT_FILENO);
  silence(STDERR_FILENO);
  int status = kCrashed;
  try {
    status = write_all(pipe, work()) ? 0 : kCrashed;
  } catch (...) {
  }
  _exit(status);
}

std::string read_all(int descriptor) {
  std::string bytes;
  std::array<char, 65536> buffer;
  for (;;) {
    const ssize_t n = read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::resources, std::string(what) + ": " + std::strerror(errno));
}

}  // namespace

IsolatedResult run_isolated(const std::function<std::string()>& work, int cpu_seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("cannot open a pipe");
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    fail("cannot start a process");
  }
  if (child == 0) {
    close(ends[0]);
    run_child(work, cpu_seconds, ends[1]);
  }
  close(ends[1]);
  IsolatedResult result;
  result.output = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.finished) {
    const bool late =
        WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    result.failure = late                  ? "took too much time or memory"
                     : WIFSIGNALED(status) ? strsignal(WTERMSIG(status))
                                           : "stopped early";
  }
  return result;
}

}  // namespace bem
