#pragma once

#include "files/file_descriptor.hpp"
#include "files/temporary_file.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace bem {

/// A file that is written under a temporary name beside its final one, so that a file of the final
/// name is always complete. Without commit() the temporary file goes away with the object; what a
/// process that was killed has left behind goes away when the next one writes the same file. A
/// device or a pipe is written directly. Everything here throws ErrorCode::resources.
class PendingFile {
 public:
  /// Creates the empty temporary file, which fails if the folder does not exist or cannot be
  /// written, or the path is a folder.
  explicit PendingFile(const std::string& path);

  /// Where others may write the contents.
  const std::string& temporary_path() const { return temporary_ ? temporary_->path() : path_; }
  void append(std::string_view bytes);

  /// Waits until the data is on the disk and gives the file its final name. Throws ErrorCode::usage
  /// if a file has that name that is to be kept.
  void commit(ExistingFile existing = ExistingFile::replace);

  /// Writes the whole file, then commit().
  void commit(const std::string& contents);

 private:
  std::string path_;
  std::optional<TemporaryFile> temporary_;
  FileDescriptor device_;
};

/// Throws ErrorCode::resources if the folder of `path` has less than `bytes` of free space.
void check_free_space(const std::string& path, double bytes);

}  // namespace bem
