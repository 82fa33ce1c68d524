#pragma once

#include "scene/body_spec.hpp"

#include <string>
#include <vector>

namespace bem {

/// A JSON file with a list of selections as scenes have them (docs/scene-format.md), at least one.
/// Throws ErrorCode::invalid_input for whatever is wrong with it.
std::vector<Selection> read_selections(const std::string& path);

}  // namespace bem
