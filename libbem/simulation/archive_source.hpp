#pragma once

#include "archive/archive_reader.hpp"
#include "simulation/scene_loader.hpp"

#include <map>
#include <memory>
#include <string>

namespace bem {

/// The archives and obstacle meshes of a scene. Each archive is opened, and its digest checked,
/// once. Every function throws ErrorCode::archive with a message that names the place in the scene
/// and the archive.
class ArchiveSource : public ModelSource {
 public:
  /// `progress` may throw to stop the loading.
  explicit ArchiveSource(Progress progress = nullptr) : progress_(std::move(progress)) {}

  /// The archive without its matrices.
  const Archive& open(const FilePath& path);

  std::shared_ptr<const BodyModel> model(const FilePath& path) override;
  TractionData tractions(const FilePath& path, const std::vector<int>& nodes) override;
  std::string digest(const FilePath& path) override { return open(path).user_block().digest; }

 private:
  TriangleMesh obstacle_mesh(const FilePath& mesh) override;

  Progress progress_;
  std::map<std::string, std::unique_ptr<Archive>> archives_;  ///< by resolved path
};

}  // namespace bem
