#pragma once

#include "files/file_descriptor.hpp"

#include <string>
#include <string_view>

namespace bem {

/// What becomes of a file that has the name already.
enum class ExistingFile { replace, keep };

/// A new file in the folder of the one that it is to become, under a name that nobody can foresee
/// and that no link leads away from. It is locked while its writer lives, so that what a killed one
/// has left can be told from what is still written: in any container that sees the folder, and on
/// any machine whose file system has locks. Everything here throws ErrorCode::resources.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& final_path);
  ~TemporaryFile();  ///< removes the file if it was not published
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  void append(std::string_view bytes);
  /// Waits until the data is on the disk.
  void sync();
  /// Gives the file its final name. Throws ErrorCode::usage if another has that name and is to be
  /// kept: one that has come since. Nothing but destruction may follow.
  void publish(ExistingFile existing = ExistingFile::replace);

  /// The name without what makes it a temporary one; any other name as it is.
  static std::string_view final_name(std::string_view name);
  /// Removes temporary files of `final_path` that nobody writes any more.
  static void remove_abandoned(const std::string& final_path);

 private:
  std::string final_path_, path_;
  FileDescriptor file_;
};

}  // namespace bem
