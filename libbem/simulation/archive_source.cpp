#include "simulation/archive_source.hpp"

#include "base/error.hpp"
#include "mesh/mesh_io.hpp"
#include "scene/location.hpp"

namespace bem {
namespace {

/// Calls `read`, whose errors name the archive, and adds the place in the scene to them.
template <class Read>
auto at_place(const FilePath& path, const Read& read) {
  try {
    return read();
  } catch (const Error& e) {
    throw Error(e.code(), where(path.location) + ": " + e.what());
  }
}

}  // namespace

const Archive& ArchiveSource::open(const FilePath& path) {
  std::unique_ptr<Archive>& archive = archives_[path.resolved];
  if (!archive) archive = at_place(path, [&] { return std::make_unique<Archive>(path.resolved); });
  return *archive;
}

std::shared_ptr<const BodyModel> ArchiveSource::model(const FilePath& path) {
  const Archive& archive = open(path);
  return at_place(path, [&] {
    return std::make_shared<const BodyModel>(archive.load_motion_matrices(progress_));
  });
}

TractionData ArchiveSource::tractions(const FilePath& path, const std::vector<int>& nodes) {
  const Archive& archive = open(path);
  return at_place(path, [&] { return archive.load_tractions(nodes, progress_); });
}

const ObstacleSurface& ArchiveSource::obstacle(const MeshObstacle& obstacle) {
  const std::string& path = obstacle.mesh.resolved;
  const Vec3& scale = obstacle.scale;
  const auto [entry, fresh] =
      obstacles_.try_emplace({path, {scale[0], scale[1], scale[2]}}, ObstacleSurface());
  if (fresh)
    entry->second = at_place(
        obstacle.mesh, [&] { return make_obstacle_surface(scaled(read_mesh(path), scale), path); });
  return entry->second;
}

}  // namespace bem
