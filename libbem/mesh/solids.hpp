#pragma once

#include "mesh/surface.hpp"

#include <string>
#include <vector>

namespace bem {

/// The separate solids of a closed surface: for each the triangles of its outer shell and of the
/// cavities in it, ascending; solids in the order of their first triangles. O(n log n).
std::vector<std::vector<int>> find_solids(const Surface& surface);

/// Throws ErrorCode::invalid_input if the surface has several solids: no material connects them, so
/// that they cannot share the frame and the matrices of one body. The message names `source` and
/// the command that parts them.
void check_single_solid(const Surface& surface, const std::string& source);

/// A mesh of these triangles of the surface, facing outward, with the nodes that they use in their
/// order.
TriangleMesh part_of(const Surface& surface, const std::vector<int>& triangles);

}  // namespace bem
