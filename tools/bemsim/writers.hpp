#pragma once

#include "output/output_format.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bem {

/// What a checkpoint knows of the output files, by format.
using OutputRecords = std::vector<FileRecords>;

using OutputFormats = std::vector<const OutputFormat*>;

/// Checks that the output of an earlier run still holds the first `frames` frames as they were when
/// its checkpoint was saved; changes nothing. Throws ErrorCode::invalid_input, or
/// ErrorCode::resources if files cannot be read.
void check_output_records(const OutputFormats& formats, const TrajectoryContents& contents,
                          const std::string& directory, std::size_t frames,
                          const OutputRecords& records);

/// The output files of a run in all its formats. Everything throws ErrorCode::resources.
class Writers {
 public:
  /// `kept` frames of an earlier run stay, of which `records` are known.
  Writers(const OutputFormats& formats, const TrajectoryContents& contents,
          const std::string& directory, std::size_t kept, const OutputRecords& records);

  void write(const Frame& frame);
  /// Waits until all frames are on the disk, and says what is there.
  OutputRecords sync();
  void close();

 private:
  std::vector<std::unique_ptr<FrameWriter>> writers_;
};

}  // namespace bem
