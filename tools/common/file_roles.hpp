#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace bem {

/// The files that a run reads and writes, all of which are named before any is opened: no output
/// may destroy an input or another output. Files are the same if they have one name or one place on
/// the disk, whatever links lead there. Empty paths stand for files that are not asked for; devices
/// and pipes may be named often.
class FileRoles {
 public:
  void reads(const std::string& path);
  void writes(const std::string& path);
  /// The folder to which a run of bemsim writes.
  void writes_below(const std::string& folder) { folder_ = folder; }

  /// Throws ErrorCode::usage.
  void check() const;

 private:
  struct File {
    std::string path, place;  ///< as given, and without links
    std::optional<std::pair<std::uint64_t, std::uint64_t>> identity;  ///< device and inode, if any
    bool has_other_names = false;
  };
  static std::optional<File> known(const std::string& path);
  static bool same(const File& a, const File& b);
  bool is_in_folder(const File& file) const;
  void check_folder() const;

  std::set<std::string> read_;  ///< paths as given: bodies share archives
  std::vector<File> inputs_, outputs_;
  std::string folder_;
};

}  // namespace bem
