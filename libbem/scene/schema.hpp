#pragma once

#include <string>

namespace bem {

/// The JSON Schema (draft 2020-12) of the scene file, as text. It says what parse_scene() accepts
/// except for what a schema cannot express: equal names, unknown bodies, increasing times,
/// directions that are zero, box corners in the wrong order, and keys twice in one object.
const std::string& scene_schema();

}  // namespace bem
