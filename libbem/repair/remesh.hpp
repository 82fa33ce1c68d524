#pragma once

#include "mesh/triangle_mesh.hpp"

#include <functional>
#include <optional>

namespace bem {

/// What remeshing aims at.
struct RemeshTarget {
  int nodes = 0;              ///< number of vertices
  double feature_angle = 40;  ///< edges whose triangles' normals enclose more stay edges [deg]
};

/// A surface of about equally large, about equilateral triangles on the given one, which must be a
/// closed manifold. The length of edges is adjusted until `accepts` takes a mesh whose number of
/// vertices differs from the target by at most 5 %; after some tries the accepted one with the
/// nearest number is returned, or nothing if there is none. CGAL's isotropic remeshing (Botsch and
/// Kobbelt 2004). O(n log n) for each try.
std::optional<TriangleMesh> remesh(const TriangleMesh& mesh, const RemeshTarget& target,
                                   const std::function<bool(const TriangleMesh&)>& accepts);

}  // namespace bem
