#pragma once

#include "base/disk_reserve.hpp"
#include "base/hdf5.hpp"
#include "base/temporary_file.hpp"
#include "output/frame.hpp"

#include <string>
#include <vector>

namespace bem {

/// Name of the trajectory in the output directory.
inline constexpr const char* kTrajectoryFile = "trajectory.h5";

/// Writes OUT_DIR/trajectory.h5:
///
///   /time                            [frames]        float64  s
///   /bodies/NAME/positions           [frames, N, 3]  float64  m, world
///   /bodies/NAME/faces               [M, 3]          int32    vertex indices from 0
///   /bodies/NAME/frame/translation   [frames, 3]     float64  m
///   /bodies/NAME/frame/rotation      [frames, 3, 3]  float64  world = translation + rotation x
///   /bodies/NAME/tractions           [frames, N, 3]  float64  Pa, world; where asked for
///
/// each with its unit as the attribute "units".
///
/// Other processes can read the file while it is written, if they open it for that (h5py:
/// swmr=True); a frame is complete when /time has it. The same way opens a file whose writer was
/// killed; after close() or the writer's destruction it opens like any other, also after a failed
/// write, which takes the file back to the frames before it. Room for a frame is reserved before it
/// is written. The file appears under its name when it can be read.
class Hdf5Trajectory : public FrameWriter {
 public:
  /// Creates the file in an existing directory, replacing an old one, whose frames that are kept
  /// are copied, O(their size). Throws ErrorCode::resources.
  Hdf5Trajectory(const std::string& directory, std::vector<TrajectoryBody> bodies,
                 std::size_t kept = 0);

  /// O(vertices); besides its own bytes a frame of a small body rewrites at most 4 KiB.
  void write(const Frame& frame) override;
  void sync() override;
  void close() override;

  /// Of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as many.
  static FileRecords read_records(const std::string& directory,
                                  const std::vector<TrajectoryBody>& bodies, std::size_t frames);

 private:
  void create_series(const std::string& path, const Hdf5Dims& extents, const char* units);
  void append(const std::string& path, const double* values);
  void create_contents();

  std::vector<TrajectoryBody> bodies_;
  TemporaryFile temporary_;  ///< until it has its name
  Hdf5File file_;
  DiskReserve reserve_;
  std::size_t frame_bytes_ = 0;  ///< that a frame adds to the file at most
  std::size_t frames_ = 0;       ///< written so far
};

}  // namespace bem
