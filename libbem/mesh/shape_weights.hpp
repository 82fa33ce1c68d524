#pragma once

#include "mesh/triangle_mesh.hpp"

#include <vector>

namespace bem {

/// Weights of the vertices when the rotation of a deformed body is measured by shape matching, for
/// a mesh with its origin at the centre of mass: int (y . n) phi_i [m^3], or areas [m^2] where one
/// of these is negative, as in strongly nonconvex bodies.
std::vector<double> shape_weights(const TriangleMesh& centred_mesh);

}  // namespace bem
