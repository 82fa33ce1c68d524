#pragma once

#include "mesh/polygon_mesh.hpp"

#include <string>
#include <string_view>

namespace bem {

/// Parses the text of an OBJ file: `v` and `f` (v, v/vt, v//vn, v/vt/vn; negative indices; three
/// corners or more), everything else is ignored. Faces may refer to vertices that follow. Lines may
/// end with LF, CR LF or CR.
///
/// Why not assimp: it stores coordinates as float32 and reorders OBJ vertices, while trajectories
/// must come out with the vertices and faces of the file.
///
/// Throws ErrorCode::invalid_input with `source`:line for a number that cannot be parsed, a vertex
/// with fewer than three coordinates, a face with fewer than three corners, a non-finite coordinate
/// and an index out of range (the last two with how many there are).
PolygonMesh parse_obj(std::string_view text, const std::string& source);

}  // namespace bem
