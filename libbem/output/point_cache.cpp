#include "output/point_cache.hpp"

#include "base/error.hpp"
#include "files/file_io.hpp"
#include "output/body_obj.hpp"
#include "output/frame_files.hpp"
#include "render/render_mesh.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>

#include <fcntl.h>

namespace bem {
namespace {

template <class T>
std::string bytes_of(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

constexpr std::size_t kSamplesAt = 28, kHeaderSize = 32;

std::string header(std::size_t vertices) {
  return std::string("POINTCACHE2\0", 12) + bytes_of(std::int32_t{1}) +
         bytes_of(static_cast<std::int32_t>(vertices)) + bytes_of(0.0F) + bytes_of(1.0F) +
         bytes_of(std::int32_t{0});
}

std::string sample(const std::vector<Vec3>& positions) {
  std::string bytes;
  bytes.reserve(positions.size() * 3 * sizeof(float));
  for (const Vec3& x : positions)
    for (int k = 0; k < 3; ++k) bytes += bytes_of(static_cast<float>(x[k]));
  return bytes;
}

/// The first samples of a cache, which it must hold.
FileDescriptor open_samples(const std::string& path, std::size_t vertices, std::size_t count) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::string found(kHeaderSize, '\0');
  std::size_t got = 0;
  const int error = file ? read_fully(file.get(), found.data(), found.size(), 0, got) : errno;
  if (error == ENOENT) throw Error(ErrorCode::invalid_input, path + ": is missing");
  check_io(error, path, "cannot be read");
  std::int32_t samples = 0;
  std::memcpy(&samples, found.data() + kSamplesAt, sizeof samples);
  if (found.compare(0, kSamplesAt, header(vertices), 0, kSamplesAt) != 0 ||
      samples < static_cast<std::int32_t>(count))
    throw Error(ErrorCode::invalid_input, path + ": does not hold the frames to go on from");
  return file;
}

/// Adds the first samples of a cache to its record.
void add_samples(const std::string& path, std::size_t vertices, std::size_t count,
                 FileRecord& record) {
  const FileDescriptor file = open_samples(path, vertices, count);
  std::string bytes(vertices * 3 * sizeof(float), '\0');
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t got = 0;
    check_io(
        read_fully(file.get(), bytes.data(), bytes.size(), kHeaderSize + i * bytes.size(), got),
        path, "cannot be read");
    record.add(std::string_view(bytes).substr(0, got));
  }
}

/// Cuts an earlier cache.
GrowingFile open_cache(const std::string& path, std::size_t vertices, std::size_t kept) {
  open_samples(path, vertices, kept);
  GrowingFile cache(path);
  cache.write(kSamplesAt, bytes_of(static_cast<std::int32_t>(kept)));
  cache.truncate(kHeaderSize + kept * vertices * 3 * sizeof(float));
  return cache;
}

std::string made_folder(const std::string& path) {
  create_folder(path);
  return path;
}

GrowingFile create_cache(const std::string& path, std::size_t vertices) {
  publish(path, header(vertices));
  return GrowingFile(path);
}

}  // namespace

PointCache::PointCache(const std::string& directory, const TrajectoryContents& contents,
                       std::size_t kept)
    : contents_((check_contents(contents), check_rest(contents.bodies), contents)),
      folder_(made_folder(directory + "/" + kPointCacheFolder)),
      notes_(folder_ + "/" + kPointCacheNotes, contents_, kept),
      frames_(kept) {
  records_ = read_records(directory, contents_, 0);
  for (const TrajectoryBody& body : contents_.bodies) {
    const std::string path = folder_ + "/" + body.name + kPointCacheExtension;
    files_.push_back(kept > 0 ? open_cache(path, body.vertices, kept)
                              : create_cache(path, body.vertices));
  }
}

void PointCache::write_meshes(const Frame& first) {
  for (std::size_t i = 0; i < contents_.bodies.size(); ++i) {
    const BodyFrame& start = first.bodies[i];
    std::vector<Vec3> places, normals;
    for (const Vec3& x : contents_.bodies[i].rest)
      places.emplace_back(start.frame.translation + start.frame.rotation * x);
    if (contents_.bodies[i].render)
      for (const PointNormal& n : contents_.bodies[i].render->obj.normals())
        normals.emplace_back(start.frame.rotation * n.direction.normalized());
    const std::string text = BodyObj(contents_.bodies[i], folder_).text(places, normals);
    publish(folder_ + "/" + contents_.bodies[i].name + kPointCacheMeshExtension, text);
    records_[2 * i + 1].add(text);
  }
}

void PointCache::write(const Frame& frame) {
  check_frame(contents_, frame);
  require(frame.index == frames_ && frames_ < std::numeric_limits<std::int32_t>::max(),
          "frames are written in their order");
  if (frames_ == 0) write_meshes(frame);
  for (std::size_t i = 0; i < contents_.bodies.size(); ++i) {
    const std::string bytes = sample(frame.bodies[i].positions);
    files_[i].write(kHeaderSize + frames_ * bytes.size(), bytes);
    files_[i].write(kSamplesAt, bytes_of(static_cast<std::int32_t>(frames_ + 1)));
    records_[2 * i].add(bytes);
  }
  records_.back().add(notes_.add(frame));  // only then: what it tells of is there
  ++frames_;
}

void PointCache::sync() {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    files_[i].sync();
    const std::string mesh = folder_ + "/" + contents_.bodies[i].name + kPointCacheMeshExtension;
    if (frames_ > 0) check_io(sync_file(mesh), mesh);
  }
  notes_.sync();
  check_io(sync_folder(folder_), folder_);
}

/// Of meshes those whose cache is there; others are not ours.
bool PointCache::is_output(const std::filesystem::path& path) {
  if (path.filename() == kPointCacheNotes) return true;
  if (path.extension() == kPointCacheExtension) return path.has_stem();
  std::error_code ignored;
  std::filesystem::path cache = path;
  return path.extension() == kPointCacheMeshExtension &&
         std::filesystem::exists(cache.replace_extension(kPointCacheExtension), ignored);
}

bool PointCache::may_write(const std::filesystem::path& path) {
  return is_output(path) || path.extension() == kPointCacheMeshExtension;
}

/// Two for each body, its cache and the mesh; then the notes.
FileRecords PointCache::read_records(const std::string& directory,
                                     const TrajectoryContents& contents, std::size_t frames) {
  FileRecords records;
  for (const TrajectoryBody& body : contents.bodies) {
    const std::string name = std::string(kPointCacheFolder) + "/" + body.name;
    records.push_back({name + kPointCacheExtension, 0, {}});
    records.push_back({name + kPointCacheMeshExtension, 0, {}});
    if (frames == 0) continue;
    add_samples(directory + "/" + name + kPointCacheExtension, body.vertices, frames,
                *(records.end() - 2));
    records.back().add(file_contents(directory + "/" + records.back().name));
  }
  records.push_back({std::string(kPointCacheFolder) + "/" + kPointCacheNotes, 0, {}});
  for (const std::string& line :
       CacheNotes::read(directory + "/" + records.back().name, contents, frames))
    records.back().add(line);
  return records;
}

void PointCache::close() {
  notes_.close();
  for (GrowingFile& file : files_) file.close();
}

}  // namespace bem
