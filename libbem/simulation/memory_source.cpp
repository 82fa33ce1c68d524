#include "simulation/memory_source.hpp"

#include "base/error.hpp"
#include "scene/location.hpp"

namespace bem {
namespace {

template <class Map>
const auto& known(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  if (found == map.end())
    throw Error(ErrorCode::archive,
                "there is no \"" + name + "\" in memory; add() it before the simulation is made");
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
  return at_place(archive.location, [&] { return known(models_, archive.resolved); });
}

TractionData MemorySource::tractions(const FilePath& archive, const std::vector<int>& nodes) {
  return extract_tractions(*model(archive), nodes);
}

TriangleMesh MemorySource::obstacle_mesh(const FilePath& mesh) {
  return known(meshes_, mesh.resolved);
}

}  // namespace bem
