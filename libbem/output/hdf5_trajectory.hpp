#pragma once

#include "files/disk_reserve.hpp"
#include "files/hdf5.hpp"
#include "files/hdf5_rows.hpp"
#include "files/temporary_file.hpp"
#include "output/frame_writer.hpp"
#include "output/trajectory_layout.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bem {

/// Name of the trajectory in the output directory.
inline constexpr const char* kTrajectoryFile = "trajectory.h5";

/// Writes OUT_DIR/trajectory.h5 (docs/trajectory-format.md; its datasets: trajectory_layout.hpp).
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
  Hdf5Trajectory(const std::string& directory, TrajectoryContents contents, std::size_t kept = 0);
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
  static FileRecords read_records(const std::string& directory, const TrajectoryContents& contents,
                                  std::size_t frames);

 private:
  using Clock = std::chrono::steady_clock;

  /// A dataset and its rows that wait until they are written.
  struct Series {
    TrajectoryDataset layout;
    std::size_t chunk_rows;              ///< in a piece of the file
    std::size_t chunk_bytes;             ///< of the pieces that hold one row
    std::size_t stored = 0;              ///< rows in the file
    std::vector<double> rows = {};       ///< that wait, and those stored since forget_stored()
    std::size_t first = 0;               ///< row of the file that they begin with
    std::vector<std::size_t> ends = {};  ///< of the frames that wait: rows up to their end
    std::optional<Hdf5Rows> dataset = {};

    std::size_t end() const { return ends.empty() ? stored : ends.back(); }
    std::size_t pieces(std::size_t end) const { return (end + chunk_rows - 1) / chunk_rows; }
    void append(std::size_t end);
    void end_frame();
    void forget_stored();
  };

  void create_datasets();
  void copy_frames(const Hdf5File& earlier, std::size_t count);
  std::size_t waiting_bytes() const;
  bool is_due() const;
  void store(std::size_t end);
  void store_together(std::size_t end);
  std::size_t bytes_of(std::size_t end) const;

  TrajectoryContents contents_;
  TemporaryFile temporary_;  ///< until it has its name
  Hdf5File file_;
  DiskReserve reserve_;
  std::vector<Series> series_;  ///< the last one is that of the times
  std::size_t stored_ = 0;      ///< frames in the file
  std::size_t frames_ = 0;      ///< and those that wait
  Clock::time_point due_;       ///< when waiting frames are to be written
};

}  // namespace bem
