#pragma once

#include "mesh/triangle_mesh.hpp"

#include <optional>

namespace bem {

/// A closed surface around any set of triangles: the boundary of what a ball of radius `alpha` [m]
/// cannot reach from outside, at a distance of about `offset` [m] from the triangles. Gaps narrower
/// than alpha are bridged, and a sheet becomes a solid that is 2 offset thick. The surface has no
/// self-intersections but may have several parts; its triangles are about alpha large. Nothing is
/// returned if CGAL fails. CGAL's alpha wrapping (Portaneri et al. 2022).
std::optional<TriangleMesh> alpha_wrap(const TriangleMesh& mesh, double alpha, double offset);

}  // namespace bem
