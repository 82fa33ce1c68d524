#pragma once

#include "common/cli.hpp"
#include "preparation.hpp"

#include <iosfwd>

namespace bem {

/// Tells the log, and whoever follows the progress.
Listener listener_of(Log& log, Progress progress);

/// Computes or finds the archives of bodies that the scene describes by mesh and material
/// (prepare_scene), and says what it does. --check computes none: the result is how many it misses.
std::size_t prepare_archives(const Options& options, Scene& scene, ArchiveSource& source,
                             const Progress& progress, Log& log);

/// --cache-info and --cache-clean. Both return the exit code.
int print_cache(std::ostream& out, const Options& options);
int clean_cache(std::ostream& out, const Options& options);

}  // namespace bem
