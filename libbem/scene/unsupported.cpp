#include "scene/unsupported.hpp"

namespace bem {

std::optional<std::pair<Location, std::string>> first_unsupported(const Scene& scene) {
  const std::string end = " not yet supported";
  for (OutputFormat format : scene.output.formats) {
    if (format == OutputFormat::vtp)
      return std::make_pair(scene.output.location, "the output format vtp is" + end);
    if (format == OutputFormat::pc2)
      return std::make_pair(scene.output.location, "the output format pc2 is" + end);
  }
  return std::nullopt;
}

}  // namespace bem
