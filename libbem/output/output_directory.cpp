#include "output/output_directory.hpp"

#include "base/error.hpp"
#include "output/hdf5_trajectory.hpp"
#include "output/obj_sequence.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

namespace bem {
namespace {

namespace fs = std::filesystem;

/// Where an output format puts its files, and how they are recognised.
struct FormatFiles {
  const char* folder;  ///< in the output directory; "" is that itself
  bool (*recognise)(std::string_view file_name);
};

constexpr FormatFiles kFormats[] = {
    {"", [](std::string_view name) { return name == kTrajectoryFile; }},
    {kObjFolder, is_obj_frame_name},
};

void remove_file(const std::string& path) {
  std::error_code code;
  fs::remove(path, code);
  if (code)
    throw Error(ErrorCode::resources, path + ": cannot be removed (" + code.message() + ")");
}

/// Removes the folders of the formats that lost files and have nothing left.
void remove_emptied_folders(const std::string& directory, const std::vector<std::string>& removed) {
  std::set<fs::path> folders;
  for (const std::string& file : removed) folders.insert(fs::path(file).parent_path());
  folders.erase((fs::path(directory) / "").parent_path());
  for (const fs::path& folder : folders) {
    std::error_code ignored;  // of a folder that is not empty
    if (!fs::is_symlink(fs::symlink_status(folder, ignored))) fs::remove(folder, ignored);
  }
}

}  // namespace

std::vector<std::string> find_output(const std::string& directory) {
  std::vector<std::string> files;
  for (const FormatFiles& format : kFormats) {
    const fs::path folder = fs::path(directory) / format.folder;
    std::error_code ended;
    for (fs::directory_iterator it(folder, ended), end; !ended && it != end; it.increment(ended)) {
      std::error_code ignored;
      if (format.recognise(it->path().filename().string()) &&
          !fs::is_directory(it->symlink_status(ignored)))
        files.push_back(it->path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void prepare_output_directory(const std::string& directory, ExistingOutput existing) {
  std::error_code code;
  fs::create_directories(directory, code);
  std::error_code unknown;
  if (!fs::is_directory(directory, unknown))
    throw Error(ErrorCode::resources, directory + ": the directory cannot be created" +
                                          (code ? " (" + code.message() + ")" : ""));
  if (existing == ExistingOutput::keep) return;
  const std::vector<std::string> files = find_output(directory);
  if (files.empty()) return;
  if (existing == ExistingOutput::refuse) {
    const std::string others =
        files.size() > 1 ? " (and " + std::to_string(files.size() - 1) + " more)" : "";
    throw Error(ErrorCode::usage, files.front() + others +
                                      ": there is output of an earlier run; --force replaces it");
  }
  for (const std::string& file : files) remove_file(file);
  remove_emptied_folders(directory, files);
}

}  // namespace bem
