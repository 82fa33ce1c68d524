#pragma once

#include "mesh/polygon_mesh.hpp"

#include <string>

namespace bem {

/// Reads the geometry of any format that assimp knows: all meshes of the scene with their node
/// transforms applied, faces with the corners that the file gives them, points and lines left out,
/// and the first set of texture coordinates.
/// Coordinates pass through float32. An indexed mesh keeps its vertices in their order; where every
/// face has vertices of its own (STL, COLLADA) equal positions are joined.
///
/// assimp 5.2 answers damaged files with failed assertions, crashes and endless loops (a truncated
/// PLY file is enough), so it works in a process of its own (files/isolated_process.hpp), with 2
/// seconds of processor time and 4 more for each megabyte, and 1 GiB of memory and a hundred times
/// the file's size.
///
/// Throws ErrorCode::invalid_input naming the file and the cause.
PolygonMesh read_with_assimp(const std::string& path);

}  // namespace bem
