#pragma once

#include "files/disk_reserve.hpp"
#include "files/file_descriptor.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace bem {

/// A file that grows while others read it. What is written is in the hands of the operating system
/// when the call returns; a full disk is noticed before anything is changed, and a write that fails
/// all the same leaves the file as it was.
class GrowingFile {
 public:
  /// Opens an existing file. Throws ErrorCode::resources.
  explicit GrowingFile(const std::string& path);

  /// Writes at a position that is not beyond the end. Throws ErrorCode::resources.
  void write(std::uint64_t position, std::string_view bytes);

  /// Cuts the file. Throws ErrorCode::resources.
  void truncate(std::uint64_t size);

  /// Waits until what was written is on the disk. Throws ErrorCode::resources.
  void sync();

  /// Nothing but destruction may follow. Throws ErrorCode::resources.
  void close();

 private:
  std::string path_;
  FileDescriptor file_;
  std::uint64_t size_ = 0;
  DiskReserve reserve_;
};

}  // namespace bem
