#pragma once

#include "files/file_descriptor.hpp"

#include <cstdint>
#include <string>

namespace bem {

/// Disk space for a file that grows, reserved before it is used: a library that keeps structures of
/// its own in the file then never meets a full disk halfway through them. The file's size does not
/// change. File systems that cannot reserve are left alone.
class DiskReserve {
 public:
  explicit DiskReserve(const std::string& path);  ///< of an existing file
  /// Messages call the file by another name.
  DiskReserve(const std::string& path, std::string name);
  ~DiskReserve() { release(); }
  DiskReserve(DiskReserve&&) noexcept = default;

  /// Makes sure that the file can grow by `bytes` from its present size. Throws
  /// ErrorCode::resources.
  void ensure(std::uint64_t bytes);
  /// Gives back what the file has not used.
  void release();

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t end_ = 0;  ///< reserved up to here
};

}  // namespace bem
