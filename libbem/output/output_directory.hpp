#pragma once

#include "files/folder_lock.hpp"

#include <string>
#include <vector>

namespace bem {

/// Name of a run's saved state in the output directory.
inline constexpr const char* kCheckpointFile = "checkpoint.bin";

/// What to do with the output of an earlier run.
enum class ExistingOutput {
  refuse,   ///< an error
  replace,  ///< remove it: --force
  keep  ///< leave it to a run that goes on where the earlier one ended, but for unfinished files
};

/// Files in the directory that a run of any output format has written, its checkpoint among them,
/// sorted. Files that only lie beside them are not among these, and neither are folders.
std::vector<std::string> find_output(const std::string& directory);

/// Would a run that writes to the directory write or remove a file of this path? In whatever
/// format, of whatever body.
bool is_output_name(const std::string& directory, const std::string& path);

/// Creates the directory (and those above it) and keeps other runs out of it as long as the result
/// lives. Throws ErrorCode::resources if it cannot be created, ErrorCode::usage if another run
/// writes there.
[[nodiscard]] FolderLock create_output_directory(const std::string& directory);

/// Deals with what an earlier run has left there. Only files of find_output are ever removed, and
/// the folder of a format that this empties. Throws ErrorCode::usage if there are such files and
/// they are to be refused, ErrorCode::resources if a file cannot be removed.
void prepare_output_directory(const std::string& directory, ExistingOutput existing);

}  // namespace bem
