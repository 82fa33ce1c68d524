#include "mesh/assimp_reader.hpp"

#include "base/error.hpp"
#include "mesh/isolated_process.hpp"
#include "mesh/weld.hpp"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include <Eigen/LU>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

namespace bem {
namespace {

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
  const bool plain = linear.isIdentity(0) && shift.isZero(0);
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    const aiVector3D& p = part.mVertices[v];
    // Without a transform nothing is computed: a single NaN stays a single one.
    const Vec3 position(p.x, p.y, p.z);
    mesh.vertices.push_back(plain ? position : Vec3(linear * position + shift));
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

TriangleMesh import(const std::string& path) {
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
    throw Error(ErrorCode::invalid_input, importer.GetErrorString());
  TriangleMesh mesh;
  append_node(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), mesh);
  return join_triangle_soup(std::move(mesh));
}

// What the child process sends: a letter, then the mesh as raw memory or the cause of failure.
constexpr char kMesh = 'M';
constexpr char kCause = 'E';

template <typename T>
void append_raw(std::string& bytes, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <typename T>
void take_raw(const std::string& bytes, std::size_t& position, std::vector<T>& values) {
  std::uint64_t count = 0;
  require(position + sizeof count <= bytes.size(), "the reader process sends a whole mesh");
  std::memcpy(&count, bytes.data() + position, sizeof count);
  position += sizeof count;
  require(count <= (bytes.size() - position) / sizeof(T), "the reader process sends a whole mesh");
  values.resize(count);
  std::memcpy(static_cast<void*>(values.data()), bytes.data() + position, count * sizeof(T));
  position += count * sizeof(T);
}

std::string import_to_bytes(const std::string& path) {
  try {
    const TriangleMesh mesh = import(path);
    std::string bytes(1, kMesh);
    append_raw(bytes, mesh.vertices);
    append_raw(bytes, mesh.triangles);
    return bytes;
  } catch (const std::bad_alloc&) {
    return kCause + std::string("it asks for more memory than there is");
  } catch (const std::exception& e) {
    return kCause + std::string(e.what());
  }
}

}  // namespace

TriangleMesh read_with_assimp(const std::string& path) {
  std::error_code unknown_size;
  const std::uintmax_t bytes = std::filesystem::file_size(path, unknown_size);
  const int seconds = 20 + static_cast<int>(unknown_size ? 0 : bytes / 500000);
  const IsolatedResult result = run_isolated([&] { return import_to_bytes(path); }, seconds);
  const auto refuse = [&](const std::string& cause) -> Error {
    return {ErrorCode::invalid_input, path + ": the mesh cannot be read: " + cause};
  };
  if (!result.finished)
    throw refuse("the file is damaged, its reader gave up (" + result.failure + ")");
  require(!result.output.empty(), "the reader process answers");
  if (result.output[0] == kCause) throw refuse(result.output.substr(1));
  TriangleMesh mesh;
  std::size_t position = 1;
  take_raw(result.output, position, mesh.vertices);
  take_raw(result.output, position, mesh.triangles);
  return mesh;
}

}  // namespace bem
