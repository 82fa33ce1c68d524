#pragma once

#include "base/text.hpp"
#include "mesh/triangle_mesh.hpp"

namespace bem {

// Words for messages about meshes.

std::string to_text(const Vec3& point);  ///< "(x, y, z)"

/// "triangle 5 (vertices 1, 7, 4)"; indices count from 0, as in the input.
std::string triangle_text(const TriangleMesh& input, std::size_t triangle);

/// "vertex 7 at (x, y, z)".
std::string vertex_text(const TriangleMesh& input, int vertex);

}  // namespace bem
