#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bem {

/// $BEM_CACHE, else bem in $XDG_CACHE_HOME, else ~/.cache/bem. Throws ErrorCode::usage if none of
/// the three variables is set.
std::string default_cache_folder();

/// A folder of archives whose names contain a digest of all that they are computed from, so that
/// an archive that is there never has to be computed again. Processes share it: while one computes
/// an archive, others that need it wait.
class ArchiveCache {
 public:
  /// Creates the folder. Throws ErrorCode::resources.
  explicit ArchiveCache(std::string folder);

  const std::string& folder() const { return folder_; }
  /// Path of the archive of this mesh file whose inputs are described by a text.
  std::string path_of(const std::string& mesh, const std::string& inputs) const;

  /// Throws ErrorCode::resources if it is a folder.
  bool has(const std::string& path) const;

  /// Calls `make`, which has to write the file, if the file is not there; before, `waiting` if
  /// another process is about to write it. Marks the file as used now. Returns whether it was made.
  bool provide(const std::string& path, const std::function<void()>& make,
               const std::function<void()>& waiting) const;

  /// Processor time that provide() has spent on making a file [s], if that is known.
  std::optional<double> seconds_to_make(const std::string& path) const;

  struct Entry {
    std::string name;
    double bytes = 0;
    double age = 0;  ///< since the last use [s]
  };
  /// What is there, last used first.
  std::vector<Entry> entries() const;

  /// Removes entries that have not been used for `age` [s], and what killed processes have left.
  /// Returns what was removed.
  std::vector<Entry> remove_older(double age) const;
  /// Removes entries, those first that have not been used for longest, until at most `bytes` are
  /// left.
  std::vector<Entry> remove_beyond(double bytes) const;

 private:
  std::string time_file(const std::string& path) const;
  void note_time(const std::string& path, double seconds) const;
  void remove_abandoned() const;
  void remove(const std::vector<Entry>& entries) const;

  std::string folder_;
};

}  // namespace bem
