#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <utility>

namespace bem {

/// The first part of `scene` that can be written in a scene file but is not simulated yet, and
/// what it is ("contact is not yet supported"). Nothing if all of the scene is supported.
std::optional<std::pair<Location, std::string>> first_unsupported(const Scene& scene);

}  // namespace bem
