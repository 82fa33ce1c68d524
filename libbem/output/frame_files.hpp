#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Files that stand for one frame of one body.

namespace bem {

/// NAME_000000.EXTENSION, with more digits where they are needed; `extension` begins with a dot.
std::string frame_file_name(const std::string& body, std::size_t frame, std::string_view extension);

/// Is this the name of such a file, of whatever body, or of the temporary file that becomes one?
bool is_frame_file_name(std::string_view file_name, std::string_view extension);

/// Removes these files from frame `first` on, and temporary ones. Throws ErrorCode::resources.
void remove_frames(const std::string& folder, std::string_view extension, std::size_t first);

/// The name under which a file is written until it is complete.
std::string temporary_name(const std::string& path);

/// Gives a file that was written under its temporary name the final one, replacing what has that
/// name. Throws ErrorCode::resources.
void publish(const std::string& path);

/// Writes a file under its temporary name and publishes it. Throws ErrorCode::resources.
void publish(const std::string& path, std::string_view contents);

/// Creates a folder, which may exist, in an existing directory. Throws ErrorCode::resources.
void create_folder(const std::string& path);

}  // namespace bem
