#pragma once

#include "mesh/polygon_mesh.hpp"
#include "mesh/triangle_mesh.hpp"

#include <string>

namespace bem {

/// What becomes of a face that crosses itself.
enum class CrossingFaces {
  refuse,  ///< an error
  fan      ///< triangles around its first corner: for meshes that are only shown
};

/// Cuts the faces of a mesh into triangles, face by face in their order, whatever format they came
/// from. Triangles stay as they are, corners that repeat the one before them are left out, and
/// mesh/face_triangles.hpp cuts the others; then diagonals that would be an edge elsewhere in the
/// mesh, too, are exchanged where that is possible. A face whose triangles cannot be found because
/// an index or a coordinate is bad becomes a fan, so that the checks of a mesh name it.
///
/// `first_triangles`, if given, becomes the index of each face's first triangle, and at its end the
/// number of triangles.
///
/// Throws ErrorCode::invalid_input for a face that crosses itself, if it is to be refused; the
/// message names `source` (with the line where it is known) and the face. O(n log n).
TriangleMesh triangulate(PolygonMesh polygons, const std::string& source,
                         CrossingFaces crossing = CrossingFaces::refuse,
                         std::vector<std::size_t>* first_triangles = nullptr);

}  // namespace bem
