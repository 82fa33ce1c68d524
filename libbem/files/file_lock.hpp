#pragma once

#include "files/file_descriptor.hpp"

#include <functional>
#include <string>

namespace bem {

/// Holds a lock by the name of a file, one process after the other, on this machine or, where the
/// file system has locks, on others. It ends with the process, however that ends. Where there are
/// no locks nothing is locked. The empty file stays, because removing it would let two processes
/// lock two files of one name.
class FileLock {
 public:
  /// Creates the file and waits for the lock; calls check_interruption() meanwhile, and `waiting`
  /// once if another process has it. Throws ErrorCode::resources if the file cannot be created.
  FileLock(const std::string& path, const std::function<void()>& waiting);

 private:
  FileDescriptor file_;
};

}  // namespace bem
