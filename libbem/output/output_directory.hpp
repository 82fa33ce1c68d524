#pragma once

#include <string>
#include <vector>

namespace bem {

/// Name of a run's saved state in the output directory.
inline constexpr const char* kCheckpointFile = "checkpoint.bin";

/// What to do with the output of an earlier run.
enum class ExistingOutput {
  refuse,   ///< an error
  replace,  ///< remove it: --force
  keep      ///< leave it to a run that goes on where the earlier one ended
};

/// Files in the directory that a run of any output format has written, its checkpoint among them,
/// sorted. Files that only lie beside them are not among these, and neither are folders.
std::vector<std::string> find_output(const std::string& directory);

/// Creates the directory (and those above it) and deals with what an earlier run has left there.
/// Only files of find_output are ever removed, and the folder of a format that this empties. Throws
/// ErrorCode::usage if there are such files and they are to be refused, ErrorCode::resources if the
/// directory cannot be created or a file cannot be removed.
void prepare_output_directory(const std::string& directory, ExistingOutput existing);

}  // namespace bem
