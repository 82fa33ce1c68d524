#pragma once

#include "options.hpp"
#include "plan.hpp"
#include "preparation/archive_cache.hpp"
#include "simulation/scene_preparation.hpp"

#include <functional>
#include <string>

namespace bem {

/// Who is told what work finds out, and how far it has come; `progress` may throw to stop it.
struct Listener {
  std::function<void(const std::string&)> note, warn;
  Progress progress;
};

/// That of the options. Throws ErrorCode::usage and ErrorCode::resources.
ArchiveCache cache_of(const Options& options);

/// Whether a body is given by mesh and material.
bool needs_cache(const Scene& scene);

/// How the archives of a scene are prepared.
PreparationOptions preparation_options(const Options& options, const Listener& listener);

}  // namespace bem
