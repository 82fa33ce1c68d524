#pragma once

#include "base/types.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace bem {

/// Faces with three or more corners, as a mesh file has them. Nothing is guaranteed about the
/// indices; triangulate (mesh/triangulate.hpp) makes triangles of them.
struct PolygonMesh {
  std::vector<Vec3> vertices;          ///< [m]
  std::vector<int> corners;            ///< vertex indices of all faces, one face after the other
  std::vector<std::size_t> starts{0};  ///< face f has the corners starts[f] .. starts[f + 1] - 1
  std::vector<int> lines;              ///< line of each face in a text file, or empty
  /// Texture coordinates and for each of the corners the index of its own, -1 for one without; both
  /// may be empty.
  std::vector<std::array<float, 2>> uvs = {};
  std::vector<int> corner_uvs = {};

  std::size_t face_count() const { return starts.size() - 1; }
  std::size_t corner_count(std::size_t face) const { return starts[face + 1] - starts[face]; }
  const int* face(std::size_t f) const { return corners.data() + starts[f]; }

  /// Ends the face whose corners were appended to `corners`.
  void end_face() { starts.push_back(corners.size()); }
};

}  // namespace bem
