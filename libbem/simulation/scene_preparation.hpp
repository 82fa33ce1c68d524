#pragma once

#include "preparation/archive_cache.hpp"
#include "preparation/body_plan.hpp"
#include "scene/scene.hpp"
#include "simulation/archive_source.hpp"

#include <functional>
#include <optional>
#include <string>

namespace bem {

/// How prepare_scene() works and what it tells.
struct PreparationOptions {
  std::string program;  ///< name and version of the caller, for archives: "bem 0.1.0"
  double memory = 0;    ///< that matrices may take while they are computed [bytes]; 0: any
  std::optional<double> frame_interval;  ///< [s], of which an automatic time step is a whole part
  std::function<void(const std::string&)> note, warn;
  /// Gets the geometries by body where MissingArchives::list finds archives missing.
  std::function<void(const std::vector<const BodyGeometry*>&)> listed;
  Progress progress;
};

/// What prepare_scene() does with an archive that is not in the cache.
enum class MissingArchives {
  compute,
  list,  ///< checks what the archive would be computed from, and says so with a note
  count  ///< nothing; nor are archives opened that are there
};

/// Gives a scene without a time step that of its archives, else automatic_time_step() for its
/// bodies; and every body with a mesh and a material, but without an archive, one in the cache: the
/// one that is there, else a new one. What the scene cannot need is not computed: loads only where
/// something can act on the body. Archives that a body names beside its mesh and material are
/// compared with them. Returns how many archives are missing, which are none if they are computed.
/// Throws with the place in the scene: ErrorCode::invalid_input for settings, meshes and materials
/// that cannot be used, ErrorCode::archive for archives that do not agree, and as precompute() and
/// write_archive().
std::size_t prepare_scene(Scene& scene, ArchiveSource& source, const ArchiveCache& cache,
                          MissingArchives missing, const PreparationOptions& options);

}  // namespace bem
