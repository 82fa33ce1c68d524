#pragma once

#include "simulation/simulation.hpp"
#include "support/models.hpp"

#include <map>

namespace bem_test {

/// Models that live in memory, by name of the archive in the scene.
class MemorySource : public bem::ModelSource {
 public:
  void add(const std::string& name, bem::BodyModel model) {
    models_[name] = std::make_shared<bem::BodyModel>(std::move(model));
  }
  void add_obstacle(const std::string& name, const bem::TriangleMesh& mesh) {
    obstacles_[name] = bem::make_obstacle_surface(mesh, name);
  }
  std::shared_ptr<const bem::BodyModel> model(const bem::FilePath& archive) override {
    return models_.at(archive.resolved);
  }
  bem::TractionData tractions(const bem::FilePath& archive,
                              const std::vector<int>& nodes) override {
    return bem::extract_tractions(*models_.at(archive.resolved), nodes);
  }
  const bem::ObstacleSurface& obstacle(const bem::MeshObstacle& obstacle) override {
    return obstacles_.at(obstacle.mesh.resolved);
  }

 private:
  std::map<std::string, std::shared_ptr<const bem::BodyModel>> models_;
  std::map<std::string, bem::ObstacleSurface> obstacles_;
};

/// A scene with one body "b" of archive "b".
inline bem::Scene one_body_scene(double time_step) {
  bem::Scene scene;
  scene.time_step = time_step;
  bem::BodySpec body;
  body.name = "b";
  body.archive.resolved = body.archive.written = "b";
  scene.bodies.push_back(body);
  return scene;
}

inline bem::Selection box_selection(const bem::Vec3& min, const bem::Vec3& max) {
  bem::Selection s;
  s.kind = bem::Selection::Kind::box;
  s.box_min = min;
  s.box_max = max;
  return s;
}

}  // namespace bem_test
