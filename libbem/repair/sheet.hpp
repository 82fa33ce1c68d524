#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// The boundary of a plate around a sheet: both of its sides, moved apart by `thickness` [m] along
/// their normals, and the rim between them. Edges may have any number of triangles, which must have
/// an area, and no two of them the same vertices. Where the sheet bends more tightly than its
/// thickness, the plate intersects itself. O(n log n).
TriangleMesh thicken(const TriangleMesh& sheet, double thickness);

}  // namespace bem
