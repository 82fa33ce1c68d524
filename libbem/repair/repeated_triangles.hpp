#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>

namespace bem {

/// Drops triangles whose vertices another triangle has as well. Of those that look the same way one
/// stays. Two that look opposite ways are a wall between two solids, of which none stays, or the
/// sides of a sheet, of which one stays: whichever leaves fewer edges without exactly two
/// triangles. O(n log n).
std::size_t drop_repeated(TriangleMesh& mesh);

/// Drops two of any four triangles that cover the same flat quadrangle, two along each of its
/// diagonals. Returns the number of triangles. O(n log n).
std::size_t drop_other_diagonals(TriangleMesh& mesh);

}  // namespace bem
