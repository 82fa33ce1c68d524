#include "common/file_roles.hpp"

#include "base/error.hpp"
#include "output/output_directory.hpp"

#include <algorithm>
#include <filesystem>

#include <sys/stat.h>

namespace bem {
namespace {

namespace fs = std::filesystem;

/// The path without links, also where the last of them leads nowhere yet.
std::string place_of(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code unknown;
  for (int i = 0; i < kMostLinks && fs::is_symlink(fs::symlink_status(path, unknown)); ++i)
    path = path.parent_path() / fs::read_symlink(path, unknown);
  return fs::weakly_canonical(fs::absolute(path, unknown), unknown).string();
}

[[noreturn]] void refuse(const std::string& text) {
  throw Error(ErrorCode::usage, text);
}

}  // namespace

/// Nothing for what is neither a file nor yet to be one.
std::optional<FileRoles::File> FileRoles::known(const std::string& path) {
  if (path.empty()) return std::nullopt;
  File file{path, place_of(path), std::nullopt, false};
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file;
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return std::nullopt;
  file.identity = {status.st_dev, status.st_ino};
  file.has_other_names = S_ISREG(status.st_mode) && status.st_nlink > 1;
  return file;
}

bool FileRoles::same(const File& a, const File& b) {
  return a.place == b.place || (a.identity && a.identity == b.identity);
}

void FileRoles::reads(const std::string& path) {
  if (!read_.insert(path).second) return;
  if (const auto file = known(path)) inputs_.push_back(*file);
}

void FileRoles::writes(const std::string& path) {
  if (const auto file = known(path)) outputs_.push_back(*file);
}

void FileRoles::check() const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    for (const File& input : inputs_)
      if (same(outputs_[i], input))
        refuse(outputs_[i].path + ": is an input and cannot be an output as well");
    for (std::size_t k = 0; k < i; ++k)
      if (same(outputs_[i], outputs_[k]))
        refuse(outputs_[i].path + ": is named for two outputs; name a file for each");
  }
  if (!folder_.empty()) check_folder();
}

bool FileRoles::is_in_folder(const File& file) const {
  if (file.place == place_of(folder_) || is_output_name(folder_, file.path) ||
      is_output_name(folder_, file.place))
    return true;
  if (!file.has_other_names) return false;
  const std::vector<std::string> earlier = find_output(folder_);
  return std::any_of(earlier.begin(), earlier.end(), [&](const std::string& path) {
    const auto other = known(path);
    return other && same(*other, file);
  });
}

void FileRoles::check_folder() const {
  for (const auto* files : {&inputs_, &outputs_})
    for (const File& file : *files)
      if (is_in_folder(file))
        refuse(file.path + ": is among the files that a run writes to " + folder_ +
               "; name another file or folder");
}

}  // namespace bem
