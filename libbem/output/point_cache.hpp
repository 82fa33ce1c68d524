#pragma once

#include "output/cache_notes.hpp"
#include "output/frame_writer.hpp"
#include "output/growing_file.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace bem {

/// Folder of the caches in the output directory, and the extensions of what is in it.
inline constexpr const char* kPointCacheFolder = "pc2";
inline constexpr const char* kPointCacheExtension = ".pc2";
inline constexpr const char* kPointCacheMeshExtension = ".obj";
inline constexpr const char* kPointCacheNotes = "scene.jsonl";

/// Writes OUT_DIR/pc2/NAME.pc2 for each body, a Point Cache 2 as Blender and Houdini read it, and
/// OUT_DIR/pc2/NAME.obj, the mesh that it moves: the rest shape where the body's frame is in frame
/// 0 (output/body_obj.hpp). OUT_DIR/pc2/scene.jsonl has times and obstacles
/// (output/cache_notes.hpp), for scripts/blender_import.py.
///
///   char[12] "POINTCACHE2\0", int32 version 1, int32 vertices, float32 first frame 0,
///   float32 sampling 1 (sample k is frame k), int32 samples; then by sample and vertex
///   3 float32, the world position [m]
///
/// all little-endian. The number of samples is right at every moment: it is written after them.
/// Single precision is the format's; times are not in it.
class PointCache : public FrameWriter {
 public:
  /// Creates the folder in an existing directory, and caches without samples. The bodies bring
  /// their rest shapes. Throws ErrorCode::resources.
  PointCache(const std::string& directory, const TrajectoryContents& contents,
             std::size_t kept = 0);

  void write(const Frame& frame) override;
  void sync() override;
  void close() override;

  /// What output/output_format.hpp asks of a format.
  static bool is_output(const std::filesystem::path& path);
  static bool may_write(const std::filesystem::path& path);
  /// Of the first frames on the disk. Throws ErrorCode::invalid_input if there are not as many.
  static FileRecords read_records(const std::string& directory, const TrajectoryContents& contents,
                                  std::size_t frames);

 private:
  void write_meshes(const Frame& first);

  TrajectoryContents contents_;
  std::string folder_;
  CacheNotes notes_;
  std::vector<GrowingFile> files_;  ///< by body
  std::size_t frames_;              ///< written so far
};

}  // namespace bem
