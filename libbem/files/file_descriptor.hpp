#pragma once

#include <utility>

#include <unistd.h>

namespace bem {

/// Owner of an open file of the operating system; a negative one is "not open".
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int id) : id_(id) {}
  FileDescriptor(FileDescriptor&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~FileDescriptor() {
    if (id_ >= 0) ::close(id_);
  }

  int get() const { return id_; }
  /// Gives the file away.
  int release() { return std::exchange(id_, -1); }
  explicit operator bool() const { return id_ >= 0; }

 private:
  int id_ = -1;
};

}  // namespace bem
