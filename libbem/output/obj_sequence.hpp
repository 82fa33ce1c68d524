#pragma once

#include "output/body_obj.hpp"
#include "output/frame_files.hpp"
#include "output/frame_writer.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace bem {

/// Folder of the frames in the output directory.
inline constexpr const char* kObjFolder = "obj";

/// Extension of the frames.
inline constexpr const char* kObjExtension = ".obj";

/// Writes OUT_DIR/obj/NAME_000000.obj, one file for each body and frame, in world coordinates [m]
/// (output/body_obj.hpp). A file appears under its name when it is complete.
class ObjSequence : public FrameWriter {
 public:
  /// Creates the folder in an existing directory. Throws ErrorCode::resources.
  ObjSequence(const std::string& directory, const TrajectoryContents& contents,
              std::size_t kept = 0);

  void write(const Frame& frame) override;
  void sync() override;
  void close() override {}

  /// What output/output_format.hpp asks of a format.
  static bool is_output(const std::filesystem::path& path);
  static bool may_write(const std::filesystem::path& path) { return is_output(path); }
  /// Of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as many.
  static FileRecords read_records(const std::string& directory, const TrajectoryContents& contents,
                                  std::size_t frames);

 private:
  TrajectoryContents contents_;
  FrameFiles files_;
  std::vector<BodyObj> texts_;  ///< by body
};

}  // namespace bem
