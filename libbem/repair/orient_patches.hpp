#pragma once

#include "mesh/triangle_mesh.hpp"

#include <cstddef>

namespace bem {

/// What orient_patches changed.
struct OrientedPatches {
  std::size_t turned = 0;  ///< triangles that were turned over
  std::size_t split = 0;   ///< vertices that were added where parts of the surface only touch
};

/// Turns the triangles of each part that edges of two triangles connect the same way (most of them
/// stay as they are), and gives parts that do not share such edges vertices of their own: every
/// edge then has one or two triangles and the triangles around every vertex form one fan. Strips
/// with one side only are cut open. O(n log n).
OrientedPatches orient_patches(TriangleMesh& mesh);

/// Moves vertices that are at exactly one place apart, each by `part` of the way to the centre of
/// its neighbours. Returns how many were moved. O(n log n).
std::size_t separate_vertices(TriangleMesh& mesh, double part);

}  // namespace bem
