#pragma once

#include "output/file_record.hpp"
#include "output/trajectory_contents.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Files that stand for one frame of one body.

namespace bem {

/// NAME_000000.EXTENSION, with more digits where they are needed; `extension` begins with a dot.
std::string frame_file_name(const std::string& body, std::size_t frame, std::string_view extension);

/// Is this the name of such a file, of whatever body?
bool is_frame_file_name(std::string_view file_name, std::string_view extension);

/// Removes these files from frame `first` on, and their temporary ones. Throws
/// ErrorCode::resources.
void remove_frames(const std::string& folder, std::string_view extension, std::size_t first);

/// Writes a file under a temporary name and gives it its own when it is complete, replacing what
/// has that name. Throws ErrorCode::resources.
void publish(const std::string& path, std::string_view contents);

/// Creates a folder, which may exist, in an existing directory. Throws ErrorCode::resources.
void create_folder(const std::string& path);

/// The contents of a file. Throws ErrorCode::invalid_input if there is none, ErrorCode::resources.
std::string file_contents(const std::string& path);

/// The files of a run that writes one for each body and frame, in a folder of the output directory.
/// Everything here throws ErrorCode::resources.
class FrameFiles {
 public:
  /// Creates the folder, which may exist; of the frames of a run that goes on `kept` stay.
  FrameFiles(const std::string& directory, const char* folder, const char* extension,
             std::size_t kept);

  const std::string& folder() const { return folder_; }
  std::size_t frames() const { return frames_; }  ///< written so far
  /// Writes the file of a body in the present frame and adds it to its record. Returns its name.
  std::string write(const std::string& body, std::string_view contents, FileRecord& record);
  void end_frame() { ++frames_; }
  /// Waits until the files of all frames are on the disk.
  void sync(const std::vector<TrajectoryBody>& bodies);

  /// One record for each body, of no frames, and of the first frames on the disk: throws
  /// ErrorCode::invalid_input if there are not as many.
  static FileRecords no_records(const char* folder, const std::vector<TrajectoryBody>& bodies,
                                const char* extension);
  static FileRecords read_records(const std::string& directory, const char* folder,
                                  const std::vector<TrajectoryBody>& bodies, const char* extension,
                                  std::size_t frames);

 private:
  std::string folder_, extension_;
  std::size_t frames_, synced_;
};

}  // namespace bem
