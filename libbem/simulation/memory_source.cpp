#include "simulation/memory_source.hpp"

#include "base/error.hpp"
#include "scene/location.hpp"

namespace bem {
namespace {

template <class Map>
const auto& known(const Map& map, const FilePath& path) {
  const auto found = map.find(path.resolved);
  if (found == map.end())
    throw Error(ErrorCode::archive, where(path.location) + ": there is no \"" + path.resolved +
                                        "\" in memory; add() it before the simulation is made");
  return found->second;
}

}  // namespace

void MemorySource::add(const std::string& name, BodyModel model) {
  models_[name] = std::make_shared<BodyModel>(std::move(model));
}

void MemorySource::add_obstacle(const std::string& name, TriangleMesh mesh) {
  meshes_[name] = std::move(mesh);
}

std::shared_ptr<const BodyModel> MemorySource::model(const FilePath& archive) {
  return known(models_, archive);
}

TractionData MemorySource::tractions(const FilePath& archive, const std::vector<int>& nodes) {
  return extract_tractions(*known(models_, archive), nodes);
}

const ObstacleSurface& MemorySource::obstacle(const MeshObstacle& obstacle) {
  const std::string& name = obstacle.mesh.resolved;
  const Vec3& scale = obstacle.scale;
  const auto [entry, fresh] =
      obstacles_.try_emplace({name, {scale[0], scale[1], scale[2]}}, ObstacleSurface());
  if (fresh)
    entry->second = make_obstacle_surface(scaled(known(meshes_, obstacle.mesh), scale), name);
  return entry->second;
}

}  // namespace bem
