#include "output/frame_files.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"
#include "files/temporary_file.hpp"

#include <cerrno>
#include <charconv>
#include <filesystem>
#include <limits>
#include <vector>

namespace bem {
namespace {

constexpr std::size_t kDigits = 6;

bool remove_suffix(std::string_view& text, std::string_view suffix) {
  if (text.size() < suffix.size() || text.substr(text.size() - suffix.size()) != suffix)
    return false;
  text.remove_suffix(suffix.size());
  return true;
}

/// Of a frame's file; a temporary one belongs to no frame before any other.
std::size_t frame_number(std::string_view file_name, std::string_view extension) {
  constexpr std::size_t kLast = std::numeric_limits<std::size_t>::max();
  if (!remove_suffix(file_name, extension)) return kLast;
  file_name.remove_prefix(file_name.find_last_of('_') + 1);
  std::size_t number = 0;
  const auto result =
      std::from_chars(file_name.data(), file_name.data() + file_name.size(), number);
  return result.ec == std::errc() ? number : kLast;
}

}  // namespace

std::string frame_file_name(const std::string& body, std::size_t frame,
                            std::string_view extension) {
  std::string number = std::to_string(frame);
  if (number.size() < kDigits) number.insert(0, kDigits - number.size(), '0');
  return body + "_" + number + std::string(extension);
}

bool is_frame_file_name(std::string_view file_name, std::string_view extension) {
  if (!remove_suffix(file_name, extension)) return false;
  const std::size_t underscore = file_name.find_last_not_of("0123456789");
  return underscore != std::string_view::npos && underscore > 0 && file_name[underscore] == '_' &&
         file_name.size() - underscore - 1 >= kDigits;
}

void remove_frames(const std::string& folder, std::string_view extension, std::size_t first) {
  std::error_code ended;
  std::vector<std::filesystem::path> removed;
  for (std::filesystem::directory_iterator it(folder, ended), end; !ended && it != end;
       it.increment(ended)) {
    const std::string name = it->path().filename().string();
    if (is_frame_file_name(TemporaryFile::final_name(name), extension) &&
        frame_number(name, extension) >= first)
      removed.push_back(it->path());
  }
  for (const auto& path : removed) {
    std::error_code code;
    std::filesystem::remove(path, code);
    if (code)
      throw Error(ErrorCode::resources,
                  path.string() + ": cannot be removed (" + code.message() + ")");
  }
}

void publish(const std::string& path, std::string_view contents) {
  TemporaryFile file(path);
  file.append(contents);
  file.publish();
}

void create_folder(const std::string& path) {
  std::error_code code;
  std::filesystem::create_directory(path, code);
  std::error_code unknown;
  if (!std::filesystem::is_directory(path, unknown))
    throw Error(ErrorCode::resources, path + ": the folder cannot be created" +
                                          (code ? " (" + code.message() + ")" : ""));
}

std::string file_contents(const std::string& path) {
  std::string bytes;
  const int error = read_all(path, bytes);
  if (error == ENOENT) throw Error(ErrorCode::invalid_input, path + ": is missing");
  check_io(error, path, "cannot be read");
  return bytes;
}

FrameFiles::FrameFiles(const std::string& directory, const char* folder, const char* extension,
                       std::size_t kept)
    : folder_(directory + "/" + folder), extension_(extension), frames_(kept), synced_(kept) {
  create_folder(folder_);
  if (kept > 0) remove_frames(folder_, extension, kept);
}

std::string FrameFiles::write(const std::string& body, std::string_view contents,
                              FileRecord& record) {
  std::string name = frame_file_name(body, frames_, extension_);
  publish(folder_ + "/" + name, contents);
  record.add(contents);
  return name;
}

void FrameFiles::sync(const std::vector<TrajectoryBody>& bodies) {
  for (; synced_ < frames_; ++synced_)
    for (const TrajectoryBody& body : bodies) {
      const std::string path = folder_ + "/" + frame_file_name(body.name, synced_, extension_);
      check_io(sync_file(path), path);
    }
  check_io(sync_folder(folder_), folder_);
}

FileRecords FrameFiles::no_records(const char* folder, const std::vector<TrajectoryBody>& bodies,
                                   const char* extension) {
  FileRecords records;
  for (const TrajectoryBody& body : bodies)
    records.push_back({std::string(folder) + "/" + body.name + "_*" + extension, 0, {}});
  return records;
}

FileRecords FrameFiles::read_records(const std::string& directory, const char* folder,
                                     const std::vector<TrajectoryBody>& bodies,
                                     const char* extension, std::size_t frames) {
  FileRecords records = no_records(folder, bodies, extension);
  for (std::size_t frame = 0; frame < frames; ++frame)
    for (std::size_t i = 0; i < bodies.size(); ++i)
      records[i].add(file_contents(directory + "/" + folder + "/" +
                                   frame_file_name(bodies[i].name, frame, extension)));
  return records;
}

}  // namespace bem
