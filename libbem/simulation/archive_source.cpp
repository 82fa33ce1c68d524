#include "simulation/archive_source.hpp"

#include "mesh/mesh_io.hpp"
#include "scene/location.hpp"

namespace bem {

const Archive& ArchiveSource::open(const FilePath& path) {
  std::unique_ptr<Archive>& archive = archives_[path.resolved];
  if (!archive)
    archive = at_place(path.location, [&] { return std::make_unique<Archive>(path.resolved); });
  return *archive;
}

std::shared_ptr<const BodyModel> ArchiveSource::model(const FilePath& path) {
  const Archive& archive = open(path);
  return at_place(path.location, [&] {
    return std::make_shared<const BodyModel>(archive.load_motion_matrices(progress_));
  });
}

TractionData ArchiveSource::tractions(const FilePath& path, const std::vector<int>& nodes) {
  const Archive& archive = open(path);
  return at_place(path.location, [&] { return archive.load_tractions(nodes, progress_); });
}

TriangleMesh ArchiveSource::obstacle_mesh(const FilePath& mesh) {
  return read_mesh(mesh.resolved);
}

}  // namespace bem
