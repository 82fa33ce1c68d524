#include "output/frame_files.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <vector>

namespace bem {
namespace {

constexpr std::size_t kDigits = 6;
constexpr std::string_view kTemporary = ".tmp";

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
  remove_suffix(file_name, kTemporary);
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
    if (is_frame_file_name(name, extension) && frame_number(name, extension) >= first)
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

std::string temporary_name(const std::string& path) {
  return path + std::string(kTemporary);
}

void publish(const std::string& path) {
  std::error_code code;
  std::filesystem::rename(temporary_name(path), path, code);
  if (code)
    throw Error(ErrorCode::resources, path + ": cannot be written (" + code.message() + ")");
}

void publish(const std::string& path, std::string_view contents) {
  std::ofstream file(temporary_name(path), std::ios::binary);
  errno = 0;
  file.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  file.close();
  if (!file)
    throw Error(ErrorCode::resources, path + ": cannot be written (" + std::strerror(errno) + ")");
  publish(path);
}

void create_folder(const std::string& path) {
  std::error_code code;
  std::filesystem::create_directory(path, code);
  std::error_code unknown;
  if (!std::filesystem::is_directory(path, unknown))
    throw Error(ErrorCode::resources, path + ": the folder cannot be created" +
                                          (code ? " (" + code.message() + ")" : ""));
}

}  // namespace bem
