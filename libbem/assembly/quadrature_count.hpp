#pragma once

#include "assembly/discretisation.hpp"
#include "mesh/triangle_mesh.hpp"

namespace bem {

/// What the quadrature of all matrices of a body consists of, apart from the number of lags.
struct QuadratureCount {
  /// Pairs of points of panels that are close to each other: of dynamic kernels and of static ones.
  double near_points = 0, static_points = 0;
};

/// Counts the points of some panels, all of the crookedest among them, and of others by the share
/// that they stand for; of panels with very many points the first half million, so that the counts
/// are the least there is. Cost: some dozens of times the number of triangles.
QuadratureCount count_quadrature(const TriangleMesh& mesh, const Discretisation& discretisation);

}  // namespace bem
