#pragma once

#include "mesh/triangle_mesh.hpp"

#include <string>

namespace bem {

/// Digest (XXH3-128, hexadecimal) of the vertices (float64) and triangles (int32) of a mesh.
std::string mesh_digest(const TriangleMesh& mesh);

}  // namespace bem
