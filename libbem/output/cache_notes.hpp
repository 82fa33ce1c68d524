#pragma once

#include "output/frame.hpp"
#include "output/growing_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace bem {

/// A text of one JSON object per line beside point caches, for what these leave out. The first line
/// has `program`, `up` (unit vector against gravity), `bodies` (names) and `obstacles`: `name` with
/// `point` and `normal` of a plane, or with `vertices` and `faces` of a mesh. Every other line is a
/// frame: `time` [s], and `places` of the obstacles in the same order, null for planes: translation
/// [m] and quaternion w, x, y, z, which take a vertex to its place in the world.
class CacheNotes {
 public:
  /// Goes on with an earlier file after `kept` > 0 frames. Throws ErrorCode::invalid_input if it
  /// does not hold them, ErrorCode::resources.
  CacheNotes(const std::string& path, const TrajectoryContents& contents, std::size_t kept);

  /// Appends the line of a frame and returns it. Throws ErrorCode::resources.
  std::string add(const Frame& frame);
  void sync() { file_.sync(); }
  void close() { file_.close(); }

  /// The lines of the first frames. Throws as the constructor.
  static std::vector<std::string> read(const std::string& path, const TrajectoryContents& contents,
                                       std::size_t frames);

 private:
  CacheNotes(const std::string& path, const std::string& start);

  std::vector<bool> is_plane_;  ///< by obstacle
  std::uint64_t end_;
  GrowingFile file_;
};

}  // namespace bem
