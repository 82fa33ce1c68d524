#pragma once

#include "scene/scene.hpp"

#include <string>

namespace bem {

/// Reads a scene file (docs/scene-format.md) and checks all that can be checked without the
/// archives and meshes that it names. Throws ErrorCode::invalid_input with file, line:column, JSON
/// pointer, what was expected and what was found, and ErrorCode::resources if the file may not be
/// read.
Scene read_scene(const std::string& path);

/// The same from a text; `file` is the name used in messages, and its folder is the one that
/// relative paths start from.
Scene parse_scene(const std::string& file, const std::string& text);

}  // namespace bem
