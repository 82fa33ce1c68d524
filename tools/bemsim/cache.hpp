#pragma once

#include "common/cli.hpp"
#include "options.hpp"
#include "preparation/archive_cache.hpp"
#include "simulation/scene_preparation.hpp"

#include <iosfwd>

namespace bem {

/// That of the command line. Throws ErrorCode::usage and ErrorCode::resources.
ArchiveCache cache_of(const Options& options);

/// How the archives of a scene are prepared, and told of in the log.
PreparationOptions preparation_options(const Options& options, const Progress& progress, Log& log);

/// Computes or finds the archives of bodies that the scene describes by mesh and material
/// (prepare_scene), and says what it does. --check computes none: the result is how many it misses.
std::size_t prepare_archives(const Options& options, Scene& scene, ArchiveSource& source,
                             const Progress& progress, Log& log);

/// --cache-info and --cache-clean. Both return the exit code.
int print_cache(std::ostream& out, const Options& options);
int clean_cache(std::ostream& out, const Options& options);

}  // namespace bem
