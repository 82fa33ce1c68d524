#include "cache.hpp"

#include "mesh/describe.hpp"
#include "plan.hpp"
#include "simulation/placement.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace bem {

namespace {

double bytes_of(const std::vector<ArchiveCache::Entry>& entries) {
  double bytes = 0;
  for (const ArchiveCache::Entry& e : entries) bytes += e.bytes;
  return bytes;
}

std::string sum_text(const std::vector<ArchiveCache::Entry>& entries) {
  return count_text(entries.size(), "archive") + ", " + bytes_text(bytes_of(entries));
}

}  // namespace

Listener listener_of(Log& log, Progress progress) {
  return {[&log](const std::string& text) { log.info(text); },
          [&log](const std::string& text) { log.warning(text); }, std::move(progress)};
}

std::size_t prepare_archives(const Options& options, Scene& scene, ArchiveSource& source,
                             const Progress& progress, Log& log) {
  const MissingArchives missing =
      options.action == Options::Action::check ? MissingArchives::list : MissingArchives::compute;
  PreparationOptions preparation = preparation_options(options, listener_of(log, progress));
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
