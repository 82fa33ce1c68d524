#include "files/folder_lock.hpp"

#include "base/error.hpp"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>

namespace bem {

FolderLock::FolderLock(const std::string& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (folder_ && ::flock(folder_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw Error(ErrorCode::usage, folder +
                                      ": another process is writing there; wait for its end or "
                                      "name another folder");
}

}  // namespace bem
