#pragma once

#include "simulation/scene_loader.hpp"

#include <map>
#include <memory>
#include <string>

namespace bem {

/// Models and obstacles that live in memory, by the name that a scene has as path of the archive or
/// mesh (FilePath::resolved). A name that is not there throws ErrorCode::archive.
class MemorySource : public ModelSource {
 public:
  void add(const std::string& name, BodyModel model);
  void add_obstacle(const std::string& name, TriangleMesh mesh);

  std::shared_ptr<const BodyModel> model(const FilePath& archive) override;
  TractionData tractions(const FilePath& archive, const std::vector<int>& nodes) override;

 private:
  TriangleMesh obstacle_mesh(const FilePath& mesh) override;

  std::map<std::string, std::shared_ptr<const BodyModel>> models_;
  std::map<std::string, TriangleMesh> meshes_;
};

}  // namespace bem
