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

/// The same from a text; `file` is the name used in messages.
Material parse_material(const std::string& file, const std::string& text);

/// The same from an object in another file.
Material read_material(const JsonValue& object);

}  // namespace bem
