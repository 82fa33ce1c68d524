#include "cache.hpp"

#include "mesh/describe.hpp"
#include "plan.hpp"
#include "simulation/placement.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace bem {

ArchiveCache cache_of(const Options& options) {
  return ArchiveCache(options.cache.empty() ? default_cache_folder() : options.cache);
}

namespace {

double bytes_of(const std::vector<ArchiveCache::Entry>& entries) {
  double bytes = 0;
  for (const ArchiveCache::Entry& e : entries) bytes += e.bytes;
  return bytes;
}

std::string sum_text(const std::vector<ArchiveCache::Entry>& entries) {
  return count_text(entries.size(), "archive") + ", " + bytes_text(bytes_of(entries));
}

bool needs_cache(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return body.source.has_value(); });
}

}  // namespace

PreparationOptions preparation_options(const Options& options, const Progress& progress, Log& log) {
  PreparationOptions preparation;
  preparation.program = version_text();
  preparation.memory = static_cast<double>(physical_memory());
  if (options.fps) preparation.frame_interval = 1 / *options.fps;
  preparation.note = [&log](const std::string& text) { log.info(text); };
  preparation.warn = [&log](const std::string& text) { log.warning(text); };
  preparation.progress = progress;
  return preparation;
}

std::size_t prepare_archives(const Options& options, Scene& scene, ArchiveSource& source,
                             const Progress& progress, Log& log) {
  const MissingArchives missing =
      options.action == Options::Action::check ? MissingArchives::list : MissingArchives::compute;
  PreparationOptions preparation = preparation_options(options, progress, log);
  preparation.listed = [&](const std::vector<const BodyGeometry*>& geometries) {
    for (const std::string& warning : warnings_of_scene(scene)) log.warning(warning);
    place_bodies(scene, geometries, source);
    for (std::size_t b = 0; b < geometries.size(); ++b) {
      std::cout << "body " << in_quotes(scene.bodies[b].name) << "\n";
      print_place(std::cout, scene.bodies[b], *geometries[b]);
    }
    std::cout << std::flush;
  };
  const std::size_t left =
      needs_cache(scene) ? prepare_scene(scene, source, cache_of(options), missing, preparation)
                         : 0;
  if (left > 0) log.info("--prepare computes what is missing; --check says more of the scene then");
  return left;
}

int print_cache(std::ostream& out, const Options& options) {
  const ArchiveCache cache = cache_of(options);
  const std::vector<ArchiveCache::Entry> entries = cache.entries();
  for (const ArchiveCache::Entry& e : entries)
    out << e.name << "  " << bytes_text(e.bytes) << "  used " << seconds_text(e.age) << " ago\n";
  out << cache.folder() << ": " << sum_text(entries) << "\n" << std::flush;
  return 0;
}

int clean_cache(std::ostream& out, const Options& options) {
  const ArchiveCache cache = cache_of(options);
  const CacheLimit& limit = options.cache_limit;
  const std::vector<ArchiveCache::Entry> removed =
      limit.age ? cache.remove_older(*limit.age) : cache.remove_beyond(*limit.bytes);
  out << cache.folder() << ": removed " << sum_text(removed) << "; left "
      << sum_text(cache.entries()) << "\n"
      << std::flush;
  return 0;
}

}  // namespace bem
