#pragma once

#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace bem {

/// The closed surface without the triangles that cut through each other, nor those within `rings`
/// edges of them, and with the holes that these leave filled. Nothing if half of the surface would
/// go or a hole cannot be filled. The result may still intersect itself. O(n log n) and the number
/// of crossing pairs.
std::optional<TriangleMesh> cut_out(const TriangleMesh& mesh, int rings);

}  // namespace bem
