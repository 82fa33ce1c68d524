#pragma once

#include "mesh/triangle_mesh.hpp"

#include <string>

namespace bem {

/// Reads the geometry of any format that assimp knows: all meshes of the scene with their node
/// transforms applied, polygons triangulated, points and lines left out. Coordinates pass through
/// float32. An indexed mesh keeps its vertices in their order; in a triangle soup (STL) equal
/// positions are joined.
///
/// assimp 5.2 answers damaged files with failed assertions, crashes and endless loops (a truncated
/// PLY file is enough), so it works in a process of its own (mesh/isolated_process.hpp).
///
/// Throws ErrorCode::invalid_input naming the file and the cause.
TriangleMesh read_with_assimp(const std::string& path);

}  // namespace bem
