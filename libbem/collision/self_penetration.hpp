#pragma once

#include "collision/penetration.hpp"

namespace bem {

/// Deepest vertex of a closed surface that is inside of another part of it: seen from just outside
/// of the vertex, the winding number of the surface is above 1/2; the depth is the distance to the
/// nearest triangle that faces the vertex. O(n m) for n vertices that have such a triangle within
/// `reach` [m], m triangles.
Penetration deepest_self_penetration(const std::vector<Triangle>& triangles,
                                     const std::vector<Vec3>& vertices, double reach);

}  // namespace bem
