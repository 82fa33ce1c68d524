#pragma once

#include "output/frame_writer.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace bem {

/// A format of trajectories: its name in scenes and on command lines, its files, and its writer. To
/// add one: a class derived from FrameWriter with a function read_records() like that below, and
/// its row in output_formats.cpp.
struct OutputFormat {
  const char* name;
  const char* folder;  ///< of its files in the output directory; "": that itself
  /// Is a path in the folder that of a file that a run has written? By its name.
  bool (*is_output)(const std::filesystem::path& path);
  /// Could a run write such a file?
  bool (*may_write)(const std::filesystem::path& path);
  /// A writer for an existing directory; `kept` as FrameWriter says. Throws ErrorCode::resources.
  std::unique_ptr<FrameWriter> (*make_writer)(const std::string& directory,
                                              const TrajectoryContents& contents, std::size_t kept);
  /// Records of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as
  /// many.
  FileRecords (*read_records)(const std::string& directory, const TrajectoryContents& contents,
                              std::size_t frames);
  bool from_trajectory = false;  ///< is it made of the trajectory of format hdf5 at the end?
};

/// All formats, in the order in which messages list them.
const std::vector<const OutputFormat*>& output_formats();
std::vector<std::string> output_format_names();
/// Null if there is none of this name.
const OutputFormat* find_output_format(const std::string& name);
/// The formats in an order in which their writers may be closed: those that are made of the
/// trajectory come last, and hdf5 is among the others then, first if it was not there.
std::vector<const OutputFormat*> with_trajectory(std::vector<const OutputFormat*> formats);

}  // namespace bem
