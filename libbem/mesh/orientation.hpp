#pragma once

#include "mesh/components.hpp"

#include <string>
#include <vector>

namespace bem {

/// Turns the surface outward in place: components at even depth get positive volume, cavities
/// negative, with a warning about those that were turned. `components` are the surface's and stay
/// so; `input` gives the indices for messages. Throws ErrorCode::invalid_input if a component
/// encloses no volume.
void orient_outward(const TriangleMesh& input, TriangleMesh& nodes,
                    std::vector<Component>& components, const std::string& source,
                    std::vector<std::string>& warnings);

}  // namespace bem
