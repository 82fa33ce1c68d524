#include "files/isolated_process.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bem {
namespace {

constexpr int kCrashed = 99, kNoMemory = static_cast<int>(ErrorCode::resources);
constexpr int kPatience = 50;  // milliseconds between two looks at interruptions

void set_limit(int which, rlim_t value) {
  const rlimit limit{value, value};
  setrlimit(static_cast<decltype(RLIMIT_CPU)>(which), &limit);
}

/// Memory of this process [B]; zeros if it cannot be found.
struct Memory {
  rlim_t address_space = 0, resident = 0;
};

Memory memory_now() {
  Memory m;
  std::ifstream("/proc/self/statm") >> m.address_space >> m.resident;
  const auto page = static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  return {m.address_space * page, m.resident * page};
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

[[noreturn]] void run_child(const std::function<std::string()>& work, const IsolatedLimits& limits,
                            int pipe, pid_t parent) {
  // Interruptions are the parent's business: it ends the child, by SIGKILL if it dies itself.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kCrashed);
  for (int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_IGN);
  for (int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE}) std::signal(signal, SIG_DFL);
  silence(STDOUT_FILENO);
  silence(STDERR_FILENO);
  int status = kCrashed;
  try {
    if (const rlim_t now = memory_now().address_space; now > 0)
      set_limit(RLIMIT_AS, now + limits.memory);
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_CPU, static_cast<rlim_t>(limits.cpu_seconds));
    status = write_all(pipe, work()) ? 0 : kCrashed;
  } catch (const Error& error) {
    if (write_all(pipe, error.what())) status = static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    status = kNoMemory;
  } catch (...) {
  }
  _exit(status);
}

[[noreturn]] void fail(const char* what) {
  throw Error(ErrorCode::resources, std::string(what) + ": " + std::strerror(errno));
}

/// A child process and the pipe that it writes to; both end with the object.
class Child {
 public:
  Child(const std::function<std::string()>& work, const IsolatedLimits& limits) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("cannot open a pipe");
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ == 0) {
      close(ends[0]);
      run_child(work, limits, ends[1], parent);
    }
    close(ends[1]);
    pipe_ = ends[0];
    if (process_ > 0) return;
    const int cause = errno;
    close(pipe_);
    errno = cause;
    fail("cannot start a process");
  }
  ~Child() {
    close(pipe_);
    if (process_ > 0) stop();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Appends what arrives within a moment; false at the end.
  bool read_some(std::string& bytes) const {
    pollfd ready{pipe_, POLLIN, 0};
    const int found = poll(&ready, 1, kPatience);
    if (found == 0 || (found < 0 && errno == EINTR)) return true;
    std::array<char, 65536> buffer;
    const ssize_t n = read(pipe_, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) return true;
    if (n <= 0) return false;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
    return true;
  }

  /// Waits for the end and returns its status.
  int wait() {
    int status = 0;
    rusage usage{};
    while (wait4(process_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    process_ = 0;
    peak_ = static_cast<rlim_t>(usage.ru_maxrss) * 1024;
    return status;
  }

  int stop() {
    kill(process_, SIGKILL);
    return wait();
  }

  /// The most memory that it had, after wait() [B].
  rlim_t peak() const { return peak_; }

 private:
  rlim_t peak_ = 0;
  pid_t process_ = 0;
  int pipe_ = -1;
};

bool is_without_memory(int status) {
  return WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory;
}

/// Passes on the Error that the work threw.
void check_error(int status, const std::string& message) {
  if (!WIFEXITED(status) || message.empty()) return;
  const int code = WEXITSTATUS(status);
  if (code != 0 && code != kCrashed) throw Error(static_cast<ErrorCode>(code), message);
}

std::string failure_text(int status) {
  constexpr const char* kTooMuch = "took too much time or memory";
  if (is_without_memory(status)) return kTooMuch;
  if (!WIFSIGNALED(status)) return "stopped early";
  const bool late = WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL;
  return late ? kTooMuch : strsignal(WTERMSIG(status));
}

}  // namespace

IsolatedResult run_isolated(const std::function<std::string()>& work,
                            const IsolatedLimits& limits) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(limits.wall_seconds);
  const rlim_t shared = memory_now().resident;
  Child child(work, limits);
  IsolatedResult result;
  bool in_time = true;
  while (in_time && child.read_some(result.output)) {
    check_interruption();
    in_time = Clock::now() < end;
  }
  const int status = in_time ? child.wait() : child.stop();
  check_error(status, result.output);
  if (is_without_memory(status) && child.peak() < shared + limits.memory / 2)
    throw Error(ErrorCode::resources, "not enough memory");
  result.finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  if (!result.finished) result.failure = failure_text(status);
  return result;
}

}  // namespace bem
