#pragma once

#include "dynamics/body.hpp"

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// What a body did over a run that its model, linear elasticity in a frame, cannot describe: what,
/// by how much, when, where, and what helps. Nothing of a body that stayed within the limits of
/// DeformationWatch.
std::optional<std::string> validity_warning(const Body& body);

/// The extremes of a body's deformation over a run.
nlohmann::ordered_json validity_json(const Body& body);

}  // namespace bem
