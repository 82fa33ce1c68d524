#include "mesh/mesh_io.hpp"

#include "base/error.hpp"
#include "base/file_io.hpp"
#include "base/pending_file.hpp"
#include "mesh/assimp_reader.hpp"
#include "mesh/obj_reader.hpp"

#include <cctype>
#include <charconv>
#include <filesystem>

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

std::string read_text(const std::string& path) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (!std::filesystem::exists(status)) refuse(path, "no such mesh file");
  if (std::filesystem::is_directory(status)) refuse(path, "is a directory, not a mesh file");
  std::string text;
  check_io(read_all(path, text), path, "the mesh file cannot be read");
  return text;
}

void append_number(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  const std::string text = read_text(path);
  if (lower_extension(path) == ".obj") return parse_obj(text, path);
  return read_with_assimp(path);
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
