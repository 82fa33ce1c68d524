#pragma once

#include "mesh/polygon_mesh.hpp"

#include <string>
#include <string_view>

namespace bem {

/// Parses the text of an OFF file: an optional first word OFF (also with the prefixes ST, C and N
/// for texture coordinates, colours and normals, which are left out), the numbers of vertices,
/// faces and edges (edges may be missing and are ignored), then a vertex and later a face in each
/// line, with colours behind them. # begins a comment.
///
/// Why not assimp: it drops faces of more than nine corners, and everything in single precision.
///
/// Throws ErrorCode::invalid_input with `source`:line for what is not such a file, binary and
/// four-dimensional ones included, a face with fewer than three corners (points and lines are left
/// out), an index out of range, and lines that are missing or too many.
PolygonMesh parse_off(std::string_view text, const std::string& source);

}  // namespace bem
