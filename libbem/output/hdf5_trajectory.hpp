#pragma once

#include "files/disk_reserve.hpp"
#include "files/hdf5.hpp"
#include "files/hdf5_rows.hpp"
#include "files/temporary_file.hpp"
#include "output/frame.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
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
/// each with its unit as the attribute "units". Where a body has a render mesh, its group has an
/// attribute "surface": "render", or "simulation" for the simulated surface beside it.
///
/// Other processes can read the file while it is written, if they open it for that (h5py:
/// swmr=True); a frame is complete when /time has it. The same way opens a file whose writer was
/// killed; after close() or the writer's destruction it opens like any other, also after a failed
/// write, which takes the file back to the frames before it. Room for frames is reserved before
/// they are written. The file appears under its name when it can be read.
///
/// The library takes a fixed time for every dataset that grows, which is most of the work where
/// there are many small bodies. There, frames are collected and written together, for two seconds
/// or ten times as long as writing takes, if that is more. The file's bytes do not depend on it.
class Hdf5Trajectory : public FrameWriter {
 public:
  /// Creates the file in an existing directory, replacing an old one, whose frames that are kept
  /// are copied, O(their size). Throws ErrorCode::resources.
  Hdf5Trajectory(const std::string& directory, std::vector<TrajectoryBody> bodies,
                 std::size_t kept = 0);
  ~Hdf5Trajectory() override;

  /// O(vertices); besides its own bytes a frame of a small body rewrites at most 4 KiB. Up to 32
  /// bodies every frame is written at once. Frames that the disk has no room for are forgotten.
  void write(const Frame& frame) override;
  /// Hands frames that wait for others to the operating system. Throws ErrorCode::resources.
  void flush();
  void sync() override;
  void close() override;

  /// What output/output_format.hpp asks of a format.
  static bool is_output(const std::filesystem::path& path);
  static bool may_write(const std::filesystem::path& path) { return is_output(path); }
  /// Of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as many.
  static FileRecords read_records(const std::string& directory,
                                  const std::vector<TrajectoryBody>& bodies, std::size_t frames);

 private:
  using Clock = std::chrono::steady_clock;

  /// One value or more for every frame. Rows wait here until they are written.
  struct Series {
    std::string path;
    std::size_t width = 1;        ///< numbers in a row
    std::size_t chunk_rows = 1;   ///< in a piece of the file
    std::size_t chunk_bytes = 0;  ///< of the pieces that hold one row
    std::vector<double> rows = {};
    std::optional<Hdf5Rows> dataset = {};
  };

  void create_contents();
  void create_series(const std::string& path, const Hdf5Dims& extents, const char* units);
  void copy_frames(const Hdf5File& earlier, std::size_t count);
  bool is_due() const;
  void store(std::size_t end);
  void store_together(std::size_t end);
  std::size_t bytes_of(std::size_t end) const;

  std::vector<TrajectoryBody> bodies_;
  TemporaryFile temporary_;  ///< until it has its name
  Hdf5File file_;
  DiskReserve reserve_;
  std::vector<Series> series_;  ///< the last one is that of the times
  std::size_t stored_ = 0;      ///< frames in the file
  std::size_t frames_ = 0;      ///< and those that wait
  std::size_t row_bytes_ = 0;   ///< of a frame
  Clock::time_point due_;       ///< when waiting frames are to be written
};

}  // namespace bem
