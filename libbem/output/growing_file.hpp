#pragma once

#include "base/disk_reserve.hpp"
#include "base/file_descriptor.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace bem {

/// A file that grows while others read it. What is written is in the hands of the operating system
/// when the call returns, and a full disk is noticed before anything is changed.
class GrowingFile {
 public:
  /// Opens an existing file. Throws ErrorCode::resources.
  explicit GrowingFile(const std::string& path);

  /// Writes at a position that is not beyond the end, in one call of the system. Throws
  /// ErrorCode::resources.
  void write(std::uint64_t position, std::string_view bytes);

  /// Cuts the file. Throws ErrorCode::resources.
  void truncate(std::uint64_t size);

  /// Nothing but destruction may follow.
  void close();

 private:
  std::string path_;
  FileDescriptor file_;
  DiskReserve reserve_;
};

}  // namespace bem
