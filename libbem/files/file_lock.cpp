#include "files/file_lock.hpp"

#include "base/interruption.hpp"
#include "files/file_io.hpp"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>

namespace bem {

FileLock::FileLock(const std::string& path, const std::function<void()>& waiting)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  constexpr auto kPause = std::chrono::milliseconds(50);
  if (!file_) check_io(errno, path, "cannot be locked");
  bool told = false;
  while (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return;
    if (!told && waiting) waiting();
    told = true;
    check_interruption();
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace bem
