#include "render/render_mesh.hpp"

#include "base/error.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/triangulate.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace bem {
namespace {

namespace fs = std::filesystem;

/// An OBJ text with the faces and texture coordinates; vertices are at the origin.
std::string obj_text_of(const PolygonMesh& mesh) {
  std::string text;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) text += "v 0 0 0\n";
  for (const auto& uv : mesh.uvs) {
    char buffer[64] = "vt ";
    char* end = std::to_chars(buffer + 3, buffer + sizeof buffer, uv[0]).ptr;
    *end++ = ' ';
    text.append(buffer, std::to_chars(end, buffer + sizeof buffer, uv[1]).ptr) += '\n';
  }
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (std::size_t c = mesh.starts[f]; c < mesh.starts[f + 1]; ++c) {
      text += ' ' + std::to_string(mesh.corners[c] + 1);
      if (!mesh.corner_uvs.empty() && mesh.corner_uvs[c] >= 0)
        text += '/' + std::to_string(mesh.corner_uvs[c] + 1);
    }
    text += '\n';
  }
  return text;
}

/// What readers of other formats let through.
void check(const PolygonMesh& mesh, const std::string& path) {
  const int n = static_cast<int>(mesh.vertices.size());
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::invalid_input, path + ": the mesh " + what);
  };
  if (mesh.face_count() == 0) refuse("has no faces that could be shown");
  for (const Vec3& v : mesh.vertices)
    if (!std::isfinite(4 * v.squaredNorm()))
      refuse("has a vertex with a coordinate that is no number or too large");
  for (int v : mesh.corners)
    if (v < 0 || v >= n) refuse("has a face with a vertex that does not exist");
}

bool is_file(const fs::path& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

/// The path as seen from another folder, if it is there and not absolute.
std::string moved_path(const fs::path& from, const std::string& name, const fs::path& to) {
  if (fs::path(name).is_absolute() || !is_file(from / name)) return name;
  std::error_code unknown;
  const fs::path moved = fs::relative(from / name, to, unknown);
  return unknown || moved.empty() ? name : moved.string();
}

}  // namespace

std::vector<std::string> RenderMesh::libraries_from(const std::string& folder) const {
  const fs::path own = fs::path(path).parent_path();
  std::vector<std::string> moved;
  for (const std::string& names : obj.libraries()) {
    std::string& out = moved.emplace_back();
    if (is_file(own / names)) {  // one name, perhaps with blanks
      out = moved_path(own, names, folder);
      continue;
    }
    std::istringstream words(names);
    for (std::string name; words >> name;)
      out += (out.empty() ? "" : " ") + moved_path(own, name, folder);
  }
  return moved;
}

RenderMesh read_render_mesh(const std::string& path, double scale) {
  MeshFile file = read_mesh_file(path);
  for (Vec3& v : file.polygons.vertices) v *= scale;
  check(file.polygons, path);
  RenderMesh mesh;
  mesh.path = path;
  mesh.obj = ObjTemplate(file.obj.empty() ? obj_text_of(file.polygons) : file.obj);
  mesh.corners = file.polygons.corners;
  mesh.starts = file.polygons.starts;
  mesh.triangles = triangulate(std::move(file.polygons), path, CrossingFaces::fan);
  return mesh;
}

}  // namespace bem
