#pragma once

#include "output/frame_files.hpp"
#include "output/frame_writer.hpp"
#include "output/pvd_collection.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace bem {

/// Folder of the frames in the output directory, their extension, and the file that lists them.
inline constexpr const char* kVtpFolder = "vtp";
inline constexpr const char* kVtpExtension = ".vtp";
inline constexpr const char* kPvdFile = "trajectory.pvd";

/// Writes OUT_DIR/vtp/NAME_000000.vtp, one file for each body and frame, and
/// OUT_DIR/vtp/trajectory.pvd, which lists them with their times [s] and the bodies as parts 0, 1,
/// ... in their order: what ParaView opens.
///
/// A .vtp file is XML PolyData whose numbers are appended as raw bytes: points (float64, world
/// [m]) and polygons are the vertices and triangles of the input mesh in their order; the point
/// data are "deformation", the position less where the body's frame takes the rest shape (float64,
/// world [m]), and the fields of the body (float64, tensors in the order xx yy zz xy yz xz, which
/// is that of VTK). The field data have the time as "TimeValue". A file appears under its name when
/// it is complete, and in the list after that.
class VtpSequence : public FrameWriter {
 public:
  /// Creates the folder in an existing directory, and an empty list. The bodies bring their rest
  /// shapes. Throws ErrorCode::resources.
  VtpSequence(const std::string& directory, const TrajectoryContents& contents,
              std::size_t kept = 0);

  void write(const Frame& frame) override;
  void sync() override;
  void close() override { list_.close(); }

  /// What output/output_format.hpp asks of a format.
  static bool is_output(const std::filesystem::path& path);
  static bool may_write(const std::filesystem::path& path) { return is_output(path); }
  /// Of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as many.
  static FileRecords read_records(const std::string& directory, const TrajectoryContents& contents,
                                  std::size_t frames);

 private:
  std::string contents_of(std::size_t body, const BodyFrame& state, double time) const;

  TrajectoryContents contents_;
  FrameFiles files_;
  PvdCollection list_;
};

}  // namespace bem
