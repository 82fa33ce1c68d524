#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// The outer side of a closed set of triangles whose edges may have any number of triangles but
/// one: what looks outward of each connected part, without the walls between cells in it. Parts
/// that touch along edges are joined there; copies of vertices are at exactly one place
/// (separate_vertices). The triangles must have an area and no two of them the same vertices.
/// O(n log n).
TriangleMesh outer_side(const TriangleMesh& mesh);

}  // namespace bem
