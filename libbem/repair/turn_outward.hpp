#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>
#include <string>

namespace bem {

/// Turns the triangles of a closed mesh outward as make_surface() does with its own, and leaves all
/// else as it is. Returns how many were turned. Throws as make_surface(); messages name `name`.
std::size_t turn_outward(TriangleMesh& mesh, const std::string& name);

}  // namespace bem
