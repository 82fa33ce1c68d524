#pragma once

#include "handover/glb.hpp"
#include "handover/usda.hpp"
#include "output/frame_writer.hpp"

#include <filesystem>
#include <string>

namespace bem {

class PendingFile;

/// A kind of file that other programs read whole, with all frames.
struct ExportKind {
  const char* extension;
  const char* file;  ///< name in the output directory
  void (*write)(const AnimatedScene& scene, const ByteSink& sink);
};

inline constexpr ExportKind kUsdaExport{".usda", "trajectory.usda", write_usda};
inline constexpr ExportKind kGlbExport{".glb", "trajectory.glb", write_glb};

/// The kind with the extension of a path; null if there is none.
const ExportKind* export_kind_of(const std::filesystem::path& path);

/// Writes a scene to a file, which the caller commits. Returns the number of bytes. Throws what the
/// kind and the file throw.
double export_scene(const ExportKind& kind, const AnimatedScene& scene, PendingFile& file);

/// A file that is made of the trajectory.h5 beside it when the run ends: all frames of one vertex
/// array belong together in it, so that it could not grow frame by frame. The writer of that
/// trajectory must be closed before; until then, and if the run is killed, an earlier file stays.
class ExportedFile : public FrameWriter {
 public:
  ExportedFile(const ExportKind& kind, const std::string& directory,
               const TrajectoryContents& contents, std::size_t kept);

  void write(const Frame& frame) override;
  void sync() override {}
  /// Makes the file; none if there is no frame. Throws ErrorCode::resources.
  void close() override;

 private:
  const ExportKind& kind_;
  std::string directory_;
  TrajectoryContents contents_;
  std::size_t frames_;
};

/// The writer of one kind, with what output/output_format.hpp asks of a format. A checkpoint counts
/// on nothing of it.
template <const ExportKind& kKind>
class ExportedAs : public ExportedFile {
 public:
  ExportedAs(const std::string& directory, const TrajectoryContents& contents, std::size_t kept = 0)
      : ExportedFile(kKind, directory, contents, kept) {}

  static bool is_output(const std::filesystem::path& path) { return path.filename() == kKind.file; }
  static bool may_write(const std::filesystem::path& path) { return is_output(path); }
  static FileRecords read_records(const std::string&, const TrajectoryContents&, std::size_t) {
    return {};
  }
};

}  // namespace bem
