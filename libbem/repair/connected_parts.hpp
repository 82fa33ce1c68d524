#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// The parts of any set of triangles that share no vertex with each other, after vertices at
/// exactly one place are joined: triangles in their order, the vertices that they use, parts in the
/// order of their first triangles. Indices are in range and coordinates finite. O(n log n).
std::vector<TriangleMesh> connected_parts(const TriangleMesh& mesh);

}  // namespace bem
