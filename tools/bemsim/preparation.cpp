#include "preparation.hpp"

#include "common/measure.hpp"
#include "common/version.hpp"

#include <algorithm>

namespace bem {

ArchiveCache cache_of(const Options& options) {
  return ArchiveCache(options.cache.empty() ? default_cache_folder() : options.cache);
}

bool needs_cache(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const BodySpec& body) { return body.source.has_value(); });
}

PreparationOptions preparation_options(const Options& options, const Listener& listener) {
  PreparationOptions preparation;
  preparation.program = version_text();
  preparation.memory = static_cast<double>(physical_memory());
  if (options.fps) preparation.frame_interval = 1 / *options.fps;
  preparation.note = listener.note;
  preparation.warn = listener.warn;
  preparation.progress = listener.progress;
  return preparation;
}

}  // namespace bem
