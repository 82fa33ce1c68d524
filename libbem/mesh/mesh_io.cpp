#include "mesh/mesh_io.hpp"

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "files/pending_file.hpp"
#include "mesh/assimp_reader.hpp"
#include "mesh/mesh_format.hpp"
#include "mesh/obj_reader.hpp"
#include "mesh/off_reader.hpp"
#include "mesh/triangulate.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>

namespace bem {
namespace {

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

[[noreturn]] void refuse(const std::string& path, const std::string& cause) {
  throw Error(ErrorCode::invalid_input, path + ": " + cause);
}

/// Is the file there? A mesh may also come through a pipe where `may_stream` says so.
void check_file(const std::string& path, bool may_stream) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) refuse(path, "no such mesh file");
  if (std::filesystem::is_directory(status)) refuse(path, "is a directory, not a mesh file");
  if (!may_stream && !std::filesystem::is_regular_file(status))
    refuse(path, "is not a file but a device or a pipe, through which only OBJ and OFF can come");
}

std::string read_text(const std::string& path, std::size_t most) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> buffer;
  while (file && text.size() < most) {
    check_interruption();
    file.read(buffer.data(), buffer.size());
    text.append(buffer.data(), static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad() || !file.is_open())
    throw Error(ErrorCode::resources, path + ": the mesh file cannot be read");
  return text;
}

}  // namespace

MeshFile read_mesh_file(const std::string& path) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  constexpr std::size_t kHead = 4000;
  const std::string extension = lower_extension(path);
  const bool own = extension == ".obj" || extension == ".off";
  check_file(path, own);
  std::string text = read_text(path, own ? kAll : kHead);
  if (const std::string format = unreadable_format(text); !format.empty())
    throw Error(ErrorCode::invalid_input, unsupported_text(path, format));
  if (extension == ".off") return {parse_off(text, path), ""};
  if (extension != ".obj") return {read_with_assimp(path), ""};
  PolygonMesh polygons = parse_obj(text, path);
  return {std::move(polygons), std::move(text)};
}

namespace {

void append_number(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  return triangulate(read_mesh_file(path).polygons, path);
}

NamedRanges read_mesh_groups(const std::string& path) {
  if (lower_extension(path) != ".obj") return {};
  MeshFile file = read_mesh_file(path);
  std::vector<std::size_t> first_triangles;
  triangulate(std::move(file.polygons), path, CrossingFaces::refuse, &first_triangles);
  NamedRanges groups = parse_obj_groups(file.obj, path);
  for (auto& [name, ranges] : groups)
    for (auto& [begin, end] : ranges) {
      begin = first_triangles[begin];
      end = first_triangles[end];
    }
  return groups;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.vertices) {
    text += "v";
    for (int k = 0; k < 3; ++k) append_number(text += " ", v[k]);
    text += "\n";
  }
  for (const Triangle& t : mesh.triangles) {
    text += "f";
    for (int v : t) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

void write_obj(const std::string& path, const TriangleMesh& mesh) {
  PendingFile(path).commit(obj_text(mesh));
}

}  // namespace bem
