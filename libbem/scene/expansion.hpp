#pragma once

#include "scene/json_document.hpp"

namespace bem {

/// The scene with what it includes and with the defaults of its bodies and obstacles written into
/// them (docs/scene-format.md, "Parts of scenes in other files" and "Defaults"). No "include" is
/// left in the scene, its bodies, its obstacles and its defaults; "defaults" stays, for the reader
/// to check. Every value keeps its place in its own file.
///
/// Throws ErrorCode::invalid_input, naming the place of the path, for files that are missing or
/// include themselves, for includes that are nested more than 50 deep, and if the scene becomes
/// larger than 2^24 values; ErrorCode::resources if a file may not be read.
JsonDocument expanded_scene(JsonDocument scene);

}  // namespace bem
