#include "preparation/archive_cache.hpp"

#include "base/error.hpp"
#include "files/digest.hpp"
#include "files/file_lock.hpp"
#include "files/temporary_file.hpp"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <regex>

namespace bem {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLocks = ".locks";
constexpr const char* kTimes = ".times";  // folder of files with processor times [s]

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

void create_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorCode::resources, folder + ": the cache cannot be created (" + error.message() +
                                          "); name another folder with --cache or BEM_CACHE");
}

/// What is fit for names of files of a mesh's name.
std::string readable_part(const std::string& mesh) {
  constexpr std::size_t kLongest = 60;
  std::string stem = fs::path(mesh).stem().string().substr(0, kLongest);
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return stem;
}

/// Whether the cache has given a file its name: other archives in the folder are not its own.
bool is_name_of_entry(const std::string& name) {
  static const std::regex pattern("[A-Za-z0-9_-]*-[0-9a-f]{32}\\.bem");
  return std::regex_match(name, pattern);
}

}  // namespace

std::string default_cache_folder() {
  if (const std::string own = environment("BEM_CACHE"); !own.empty()) return own;
  if (const std::string cache = environment("XDG_CACHE_HOME"); !cache.empty())
    return cache + "/bem";
  if (const std::string home = environment("HOME"); !home.empty()) return home + "/.cache/bem";
  throw Error(ErrorCode::usage,
              "there is no place for computed archives: name a folder with --cache or BEM_CACHE");
}

ArchiveCache::ArchiveCache(std::string folder) : folder_(std::move(folder)) {
  create_folder(folder_);
}

std::string ArchiveCache::path_of(const std::string& mesh, const std::string& inputs) const {
  return folder_ + "/" + readable_part(mesh) + "-" + digest_of(inputs) + ".bem";
}

bool ArchiveCache::has(const std::string& path) const {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status))
    throw Error(ErrorCode::resources,
                path + ": there is a folder in place of an archive of the cache; remove it");
  return fs::exists(status);
}

bool ArchiveCache::provide(const std::string& path, const std::function<void()>& make,
                           const std::function<void()>& waiting) const {
  bool made = false;
  if (!has(path)) {
    create_folder(folder_ + "/" + kLocks);
    const FileLock lock(folder_ + "/" + kLocks + "/" + fs::path(path).stem().string(), waiting);
    made = !has(path);
    if (made) {
      const std::clock_t start = std::clock();
      make();
      note_time(path, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  std::error_code error;  // the time of a file of another user stays
  fs::last_write_time(path, fs::file_time_type::clock::now(), error);
  return made;
}

std::string ArchiveCache::time_file(const std::string& path) const {
  return folder_ + "/" + kTimes + "/" + fs::path(path).stem().string();
}

/// A time that cannot be written is not known later.
void ArchiveCache::note_time(const std::string& path, double seconds) const {
  std::error_code error;
  fs::create_directories(folder_ + "/" + kTimes, error);
  std::ofstream(time_file(path)) << std::lround(1000 * seconds) << " ms\n";
}

std::optional<double> ArchiveCache::seconds_to_make(const std::string& path) const {
  long milliseconds = 0;
  if (!(std::ifstream(time_file(path)) >> milliseconds)) return std::nullopt;
  return static_cast<double>(milliseconds) / 1000;
}

std::vector<ArchiveCache::Entry> ArchiveCache::entries() const {
  std::vector<Entry> out;
  std::error_code error;
  const auto now = fs::file_time_type::clock::now();
  const fs::directory_iterator files(folder_, error);
  if (error)
    throw Error(ErrorCode::resources, folder_ + ": cannot be read (" + error.message() + ")");
  for (const fs::directory_entry& file : files) {
    if (!is_name_of_entry(file.path().filename().string())) continue;
    const std::uintmax_t bytes = file.file_size(error);
    if (error) continue;  // another process has removed it
    const std::chrono::duration<double> age = now - file.last_write_time(error);
    out.push_back({file.path().filename().string(), static_cast<double>(bytes), age.count()});
  }
  std::sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) { return a.age < b.age; });
  return out;
}

void ArchiveCache::remove_abandoned() const {
  std::error_code error;
  std::vector<std::string> finals;
  for (const fs::directory_entry& file : fs::directory_iterator(folder_, error)) {
    const std::string name = file.path().filename().string();
    const std::string final_name(TemporaryFile::final_name(name));
    if (final_name != name && is_name_of_entry(final_name))
      finals.push_back(folder_ + "/" + final_name);
  }
  for (const std::string& path : finals) TemporaryFile::remove_abandoned(path);
}

void ArchiveCache::remove(const std::vector<Entry>& entries) const {
  std::error_code error;
  for (const Entry& e : entries) {
    std::error_code unknown;
    fs::remove(time_file(e.name), unknown);
    fs::remove(folder_ + "/" + e.name, error);
    if (error)
      throw Error(ErrorCode::resources,
                  folder_ + "/" + e.name + ": cannot be removed (" + error.message() + ")");
  }
}

std::vector<ArchiveCache::Entry> ArchiveCache::remove_older(double age) const {
  remove_abandoned();
  std::vector<Entry> old;
  for (const Entry& e : entries())
    if (e.age >= age) old.push_back(e);
  remove(old);
  return old;
}

std::vector<ArchiveCache::Entry> ArchiveCache::remove_beyond(double bytes) const {
  remove_abandoned();
  std::vector<Entry> beyond;
  double kept = 0;
  for (const Entry& e : entries()) {
    kept += e.bytes;
    if (kept > bytes) beyond.push_back(e);
  }
  remove(beyond);
  return beyond;
}

}  // namespace bem
