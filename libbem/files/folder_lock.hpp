#pragma once

#include "files/file_descriptor.hpp"

#include <string>

namespace bem {

/// Keeps other processes that lock the same folder out, on this machine or, where the file system
/// has locks, on others. It ends with the process, however that ends, and leaves no file behind.
class FolderLock {
 public:
  /// Throws ErrorCode::usage if another process has the lock. Where there are no locks nothing is
  /// locked.
  explicit FolderLock(const std::string& folder);

 private:
  FileDescriptor folder_;
};

}  // namespace bem
