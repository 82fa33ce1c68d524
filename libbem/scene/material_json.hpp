#pragma once

#include "base/material.hpp"
#include "scene/json_reader.hpp"

#include <string>

namespace bem {

/// Reads a material file (docs/scene-format.md): `name`, `density` [kg/m^3], `poisson_ratio` in
/// [0, 0.5], one of `shear_modulus` and `youngs_modulus` [Pa] (mu = E / (2 (1 + nu))), and
/// optionally `time_step` [s]. Throws ErrorCode::invalid_input naming the place of a mistake, and
/// ErrorCode::resources if the file may not be read.
Material read_material(const std::string& path);

/// The material of a scene: an object as in a material file, a name of scene/named_materials.hpp,
/// or a path relative to the folder of the scene. Throws as read_material() and find_material().
Material read_material_value(const JsonValue& value);

/// The same from a text; `file` is the name used in messages.
Material parse_material(const std::string& file, const std::string& text);

}  // namespace bem
