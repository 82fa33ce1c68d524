#pragma once

#include "mesh/triangle_mesh.hpp"
#include "render/obj_template.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace bem {

/// A mesh that is shown in place of the surface that is simulated: whatever its file says of faces,
/// texture coordinates, groups and materials is kept, and it need not be closed. See
/// SurfaceBinding for how it moves.
struct RenderMesh {
  TriangleMesh triangles;           ///< vertices in the file's order [m], and its faces cut
  std::vector<int> corners;         ///< vertices of the faces, one face after the other
  std::vector<std::size_t> starts;  ///< face f has the corners starts[f] .. starts[f + 1] - 1
  ObjTemplate obj;                  ///< the file's text; that of a new OBJ file for other formats
  std::string path;                 ///< of the file

  std::size_t face_count() const { return starts.size() - 1; }
  /// What follows mtllib in the OBJ text of a file in another folder: paths that lead from there to
  /// the libraries, for those that exist.
  std::vector<std::string> libraries_from(const std::string& folder) const;
};

/// Reads a mesh file as read_mesh_file() (mesh/mesh_io.hpp) does and multiplies its coordinates.
/// Faces that cross themselves become fans of triangles. Throws as that function, and
/// ErrorCode::invalid_input for a mesh without faces and for coordinates that are not finite.
RenderMesh read_render_mesh(const std::string& path, double scale);

}  // namespace bem
