#pragma once

#include "mesh/triangle_mesh.hpp"

#include <string>
#include <vector>

namespace bem {

/// A triangle whose smallest height is below this part of its longest edge has zero area.
inline constexpr double kZeroHeightRatio = 1e-8;

/// A triangle below this is warned about: quadrature and conditioning suffer.
inline constexpr double kThinHeightRatio = 0.01;

/// The checks below throw ErrorCode::invalid_input. The message names `source`, the first bad
/// element (indices count from 0, as in the input), how many there are, and a cure.

/// What must hold before vertices can be compared: at least one triangle, indices in range, finite
/// coordinates. O(n).
void check_elements(const TriangleMesh& input, const std::string& source);

/// What makes the welded mesh `nodes` a closed, consistently oriented manifold without zero-area
/// triangles; nodes.triangles[t] belongs to input.triangles[t]. Checked in the order zero-area
/// triangle, non-manifold edge, open boundary, inconsistent orientation, non-manifold vertex; the
/// first kind found is reported. O(n log n).
void check_closed_manifold(const TriangleMesh& input, const TriangleMesh& nodes,
                           const std::string& source);

/// Adds a warning if the mesh has very thin triangles. O(n).
void warn_thin_triangles(const TriangleMesh& input, const TriangleMesh& nodes,
                         const std::string& source, std::vector<std::string>& warnings);

}  // namespace bem
