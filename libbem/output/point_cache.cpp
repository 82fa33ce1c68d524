#include "output/point_cache.hpp"

#include "base/error.hpp"
#include "mesh/mesh_io.hpp"
#include "output/frame_files.hpp"

#include <cstdint>
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

}  // namespace

PointCache::PointCache(const std::string& directory, const std::vector<TrajectoryBody>& bodies)
    : bodies_((check_bodies(bodies), check_rest(bodies), bodies)),
      folder_(directory + "/" + kPointCacheFolder) {
  create_folder(folder_);
  for (const TrajectoryBody& body : bodies_) {
    const std::string path = folder_ + "/" + body.name + kPointCacheExtension;
    publish(path, header(body.vertices));
    files_.emplace_back(path);
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
