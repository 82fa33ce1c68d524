#include "simulation/memory_source.hpp"

namespace bem {

void MemorySource::add(const std::string& name, BodyModel model) {
  models_[name] = std::make_shared<BodyModel>(std::move(model));
}

void MemorySource::add_obstacle(const std::string& name, TriangleMesh mesh) {
  meshes_[name] = std::move(mesh);
}

std::shared_ptr<const BodyModel> MemorySource::model(const FilePath& archive) {
  return models_.at(archive.resolved);
}

TractionData MemorySource::tractions(const FilePath& archive, const std::vector<int>& nodes) {
  return extract_tractions(*models_.at(archive.resolved), nodes);
}

const ObstacleSurface& MemorySource::obstacle(const MeshObstacle& obstacle) {
  const std::string& name = obstacle.mesh.resolved;
  const Vec3& scale = obstacle.scale;
  const auto [entry, fresh] =
      obstacles_.try_emplace({name, {scale[0], scale[1], scale[2]}}, ObstacleSurface());
  if (fresh) entry->second = make_obstacle_surface(scaled(meshes_.at(name), scale), name);
  return entry->second;
}

}  // namespace bem
