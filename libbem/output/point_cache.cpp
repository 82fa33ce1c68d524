#include "output/point_cache.hpp"

#include "base/error.hpp"
#include "mesh/mesh_io.hpp"
#include "output/frame_files.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

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

/// Cuts an earlier cache.
GrowingFile open_cache(const std::string& path, std::size_t vertices, std::size_t kept) {
  std::ifstream file(path, std::ios::binary);
  std::string found(kHeaderSize, '\0');
  file.read(found.data(), static_cast<std::streamsize>(found.size()));
  std::int32_t samples = 0;
  std::memcpy(&samples, found.data() + kSamplesAt, sizeof samples);
  file.seekg(0, std::ios::end);
  const auto bytes = static_cast<std::uint64_t>(file.tellg());
  const std::uint64_t needed = kHeaderSize + kept * vertices * 3 * sizeof(float);
  if (!file || bytes < needed ||
      found.compare(0, kSamplesAt, header(vertices), 0, kSamplesAt) != 0 ||
      samples < static_cast<std::int32_t>(kept))
    throw Error(ErrorCode::resources, path + ": does not hold the frames to go on from");
  GrowingFile cache(path);
  cache.write(kSamplesAt, bytes_of(static_cast<std::int32_t>(kept)));
  cache.truncate(needed);
  return cache;
}

GrowingFile create_cache(const std::string& path, std::size_t vertices) {
  publish(path, header(vertices));
  return GrowingFile(path);
}

}  // namespace

PointCache::PointCache(const std::string& directory, const std::vector<TrajectoryBody>& bodies,
                       std::size_t kept)
    : bodies_((check_bodies(bodies), check_rest(bodies), bodies)),
      folder_(directory + "/" + kPointCacheFolder),
      frames_(kept) {
  create_folder(folder_);
  for (const TrajectoryBody& body : bodies_) {
    const std::string path = folder_ + "/" + body.name + kPointCacheExtension;
    files_.push_back(kept > 0 ? open_cache(path, body.vertices, kept)
                              : create_cache(path, body.vertices));
  }
}

void PointCache::write_meshes(const Frame& first) const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyFrame& start = first.bodies[i];
    TriangleMesh mesh{{}, bodies_[i].triangles};
    for (const Vec3& x : bodies_[i].rest)
      mesh.vertices.push_back(start.translation + start.rotation * x);
    const std::string path = folder_ + "/" + bodies_[i].name + kPointCacheMeshExtension;
    write_obj(temporary_name(path), mesh);
    publish(path);
  }
}

void PointCache::write(const Frame& frame) {
  check_frame(bodies_, frame);
  require(frame.index == frames_ && frames_ < std::numeric_limits<std::int32_t>::max(),
          "frames are written in their order");
  if (frames_ == 0) write_meshes(frame);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const std::string bytes = sample(frame.bodies[i].positions);
    files_[i].write(kHeaderSize + frames_ * bytes.size(), bytes);
    files_[i].write(kSamplesAt, bytes_of(static_cast<std::int32_t>(frames_ + 1)));
  }
  ++frames_;
}

void PointCache::close() {
  for (GrowingFile& file : files_) file.close();
}

}  // namespace bem
