#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <functional>
#include <vector>

namespace bem {

/// Two ways of building closed surfaces, used by mesh/shapes.hpp.

/// Surface of the cells of a cells[0] x cells[1] x cells[2] lattice for which `filled` holds, two
/// triangles per exposed square, outward; vertices are the lattice points (integers), ordered by
/// z, y, x. O(number of cells).
TriangleMesh lattice_surface(const std::array<int, 3>& cells,
                             const std::function<bool(int, int, int)>& filled);

/// Distance from the z axis and height [m].
struct MeridianPoint {
  double radius;
  double height;
};

/// Surface swept by a profile that runs from one pole (radius 0) to another, with the body on its
/// left when the radius points right. Rings get vertices in proportion to their radius, `segments`
/// at the largest, so that triangles stay of one size towards the poles.
TriangleMesh revolve(const std::vector<MeridianPoint>& profile, int segments);

}  // namespace bem
