#include "mesh/mesh_io.hpp"

#include "base/error.hpp"
#include "mesh/obj_reader.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

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
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (file.bad() || !file.is_open())
    throw Error(ErrorCode::resources, path + ": the mesh file cannot be read");
  return std::move(text).str();
}

Eigen::Matrix4d to_eigen(const aiMatrix4x4& matrix) {
  Eigen::Matrix4d m;
  for (unsigned i = 0; i < 4; ++i)
    for (unsigned j = 0; j < 4; ++j) m(i, j) = static_cast<double>(matrix[i][j]);
  return m;
}

void append_mesh(const aiMesh& part, const Eigen::Matrix4d& transform, TriangleMesh& mesh) {
  const int offset = static_cast<int>(mesh.vertices.size());
  const Mat3 linear = transform.topLeftCorner<3, 3>();
  const Vec3 shift = transform.topRightCorner<3, 1>();
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    mesh.vertices.emplace_back(linear * Vec3(p.x, p.y, p.z) + shift);
  }
  // A mirroring transform turns counter-clockwise into clockwise.
  const bool mirrored = linear.determinant() < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices != 3) continue;
    const auto corner = [&](int k) { return offset + static_cast<int>(face.mIndices[k]); };
    mesh.triangles.push_back({corner(0), corner(mirrored ? 2 : 1), corner(mirrored ? 1 : 2)});
  }
}

void append_node(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent,
                 TriangleMesh& mesh) {
  const Eigen::Matrix4d transform = parent * to_eigen(node.mTransformation);
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    append_mesh(*scene.mMeshes[node.mMeshes[m]], transform, mesh);
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    append_node(scene, *node.mChildren[c], transform, mesh);
}

/// A file that repeats the corners of every triangle (STL) carries no vertex order worth keeping:
/// join equal positions. An indexed mesh stays as it is. assimp's own joining compares with an
/// absolute tolerance of 1e-5, which is not small for a mesh in metres.
TriangleMesh join_triangle_soup(TriangleMesh mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  if (mesh.vertices.size() != 3 * mesh.triangles.size()) return mesh;
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) return mesh;
  for (const Triangle& t : mesh.triangles)
    for (int v : t)
      if (v < 0 || v >= n) return mesh;
  return weld(mesh).mesh;
}

TriangleMesh read_with_assimp(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(
      AI_CONFIG_PP_RVC_FLAGS,
      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
          aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent |
                                  aiProcess_Triangulate | aiProcess_SortByPType);
  if (scene == nullptr || scene->mRootNode == nullptr)
    refuse(path, std::string("the mesh cannot be read: ") + importer.GetErrorString());
  TriangleMesh mesh;
  append_node(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), mesh);
  return join_triangle_soup(std::move(mesh));
}

void append_number(std::string& text, double value) {
  char buffer[40];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

TriangleMesh read_mesh(const std::string& path) {
  const std::string text = read_text(path);
  if (lower_extension(path) == ".obj") return parse_obj(text, path);
  try {
    return read_with_assimp(path);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    refuse(path, "the mesh cannot be read: it asks for more memory than there is");
  } catch (const std::exception& e) {
    refuse(path, std::string("the mesh cannot be read: ") + e.what());
  }
}

void write_obj(const std::string& path, const TriangleMesh& mesh) {
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
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Error(ErrorCode::resources, path + ": cannot be written");
}

}  // namespace bem
