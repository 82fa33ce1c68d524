#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// Both sides of a set of triangles that need not bound a volume. Every triangle occurs twice, as
/// it is and turned over. Sides that look into the same wedge between two triangles of an edge are
/// neighbours, so each layer is a surface of consistent orientation whose edges have one or two
/// triangles, whatever the edges of the set have (one, two, three, ...). A vertex occurs once for
/// every fan of neighbours around it.
struct TwoSided {
  TriangleMesh layers;        ///< triangles 2 t and 2 t + 1 are the sides of triangle t
  std::vector<Triangle> rim;  ///< closes the gap between layers that are moved apart, at edges of
                              ///< one triangle
  std::vector<Vec3> offsets;  ///< by vertex: moves it by this times a length, and the triangles
                              ///< around it move by that length along their normals, or less where
                              ///< they meet at a sharp edge
};

/// The triangles must have an area and no two of them the same vertices. O(n log n).
TwoSided make_two_sided(const TriangleMesh& mesh);

}  // namespace bem
