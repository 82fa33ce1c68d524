#pragma once

#include "base/file_descriptor.hpp"

#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace bem_fuzz {

/// A file with a path that is on no disk.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& contents) : file_(memfd_create("input", 0)) {
    if (write(file_.get(), contents.data(), contents.size()) !=
        static_cast<ssize_t>(contents.size()))
      std::abort();
  }
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }

 private:
  bem::FileDescriptor file_;
};

}  // namespace bem_fuzz
