#include "output/output_directory.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"
#include "files/temporary_file.hpp"
#include "output/output_format.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

namespace bem {
namespace {

namespace fs = std::filesystem;

fs::path final_path(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.parent_path() / TemporaryFile::final_name(name);
}

bool is_checkpoint(const fs::path& path) {
  return path.filename() == kCheckpointFile;
}

/// Files of the formats, and the checkpoint: calls f(folder, is_output, may_write).
template <class F>
void for_each_kind(const std::string& directory, const F& f) {
  f(fs::path(directory), &is_checkpoint, &is_checkpoint);
  for (const OutputFormat* format : output_formats())
    f(fs::path(directory) / format->folder, format->is_output, format->may_write);
}

fs::path canonical_folder(const fs::path& path) {
  std::error_code unknown;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, unknown) / "", unknown);
  return whole.has_filename() ? whole : whole.parent_path();
}

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
  for_each_kind(directory, [&](const fs::path& folder, auto is_output, auto /*may_write*/) {
    std::error_code ended;
    for (fs::directory_iterator it(folder, ended), end; !ended && it != end; it.increment(ended)) {
      std::error_code ignored;
      if (is_output(final_path(it->path())) && !fs::is_directory(it->symlink_status(ignored)))
        files.push_back(it->path().string());
    }
  });
  std::sort(files.begin(), files.end());
  return files;
}

bool is_output_name(const std::string& directory, const std::string& path) {
  const fs::path own_folder = canonical_folder(folder_of(path));
  bool found = false;
  for_each_kind(directory, [&](const fs::path& folder, auto /*is_output*/, auto may_write) {
    found = found || (own_folder == canonical_folder(folder) && may_write(path));
  });
  return found;
}

FolderLock create_output_directory(const std::string& directory) {
  std::error_code code;
  const bool created = fs::create_directories(directory, code);
  std::error_code unknown;
  if (!fs::is_directory(directory, unknown))
    throw Error(ErrorCode::resources, directory + ": the directory cannot be created" +
                                          (code ? " (" + code.message() + ")" : ""));
  if (created) check_io(sync_folder(folder_of(directory)), directory);
  return FolderLock(directory);
}

void prepare_output_directory(const std::string& directory, ExistingOutput existing) {
  const std::vector<std::string> files = find_output(directory);
  if (existing == ExistingOutput::keep) {
    for (const std::string& file : files)
      if (final_path(file) != file) remove_file(file);
    return;
  }
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
