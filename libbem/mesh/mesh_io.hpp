#pragma once

#include "mesh/obj_groups.hpp"
#include "mesh/polygon_mesh.hpp"
#include "mesh/triangle_mesh.hpp"

#include <string>

namespace bem {

/// Reads the triangles of a mesh file; faces with more corners are cut into triangles
/// (mesh/triangulate.hpp), everything but geometry is left out. The result is what the file says,
/// unchecked: see make_surface.
///
/// OBJ and OFF files (by extension) go through readers of our own in double precision that keep the
/// file's vertices and faces in their order. Every other format goes through assimp: single
/// precision, node transforms applied, and vertices joined where the format (STL) repeats them in
/// every face.
///
/// Throws ErrorCode::invalid_input if the file does not exist, has a format that is not supported,
/// or cannot be understood (the message names the file, for OBJ and OFF also the line), and
/// ErrorCode::resources if it exists but must not be read. Calls check_interruption() all the time.
TriangleMesh read_mesh(const std::string& path);

/// What is read of a file before its faces are cut.
struct MeshFile {
  PolygonMesh polygons;
  std::string obj;  ///< the text of an OBJ file; empty for other formats
};

/// The faces of a file as it has them, read as read_mesh() does. Texture coordinates of OBJ files
/// are in their text alone (render/obj_template.hpp).
MeshFile read_mesh_file(const std::string& path);

/// The triangles of a mesh file by the names of the groups, objects and materials (`usemtl`) that
/// they are in; only OBJ files have such names. Throws as read_mesh().
NamedRanges read_mesh_groups(const std::string& path);

/// What an OBJ file of the mesh says. Coordinates are the shortest decimals that read back to the
/// same double.
std::string obj_text(const TriangleMesh& mesh);

/// Writes an OBJ file; an existing one is replaced when it is complete. Throws ErrorCode::resources
/// if the file cannot be written.
void write_obj(const std::string& path, const TriangleMesh& mesh);

}  // namespace bem
