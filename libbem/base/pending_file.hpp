#pragma once

#include <string>

namespace bem {

/// A file that is written under a temporary name beside its final one, so that a file of the final
/// name is always complete. Without commit() the temporary file goes away with the object; what a
/// process that was killed has left behind goes away when the next one writes the same file. A
/// device or a pipe is written directly.
class PendingFile {
 public:
  /// Creates the empty temporary file. Throws ErrorCode::resources if the folder does not exist or
  /// cannot be written.
  explicit PendingFile(const std::string& path);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& temporary_path() const { return temporary_; }
  /// Is this the name of a temporary file of any process that writes a file `final_name`?
  static bool is_temporary(const std::string& name, const std::string& final_name);

  /// Waits until the data is on the disk and gives the file its final name, replacing what has that
  /// name. Throws ErrorCode::resources.
  void commit();

  /// Writes the whole file, then commit(). Throws ErrorCode::resources.
  void commit(const std::string& contents);

 private:
  std::string path_, temporary_;
  bool exists_ = false;  ///< the temporary file is there and has to be removed
};

/// Throws ErrorCode::resources if the folder of `path` has less than `bytes` of free space.
void check_free_space(const std::string& path, double bytes);

}  // namespace bem
