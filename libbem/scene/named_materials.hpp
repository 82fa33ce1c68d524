#pragma once

#include "base/material.hpp"

#include <string>
#include <vector>

namespace bem {

/// A material that needs no file, with typical values: docs/scene-format.md lists them with the
/// same sources.
struct NamedMaterial {
  const char* name;
  double density;         ///< [kg/m^3]
  double youngs_modulus;  ///< [Pa]
  double poisson_ratio;
  const char* source;

  Material material() const;
};

const std::vector<NamedMaterial>& named_materials();

/// Whether there is a material of this name.
bool is_named_material(const std::string& name);

/// Throws ErrorCode::invalid_input with all names, and the nearest one, if there is none.
Material named_material(const std::string& name);

/// The material that a text names: that of the table if it has this name, or else that of the file
/// with this path, which is relative to `folder` (scene/material_json.hpp). A text that is neither,
/// and has no slash and no ".json" at its end, is taken for a misspelt name. A file that is called
/// like a material needs a path with a slash: "./rubber". Throws ErrorCode::invalid_input, and
/// read_material()'s errors.
Material find_material(const std::string& text, const std::string& folder = "");

}  // namespace bem
