#include "mesh/assimp_reader.hpp"

#include "base/error.hpp"
#include "files/isolated_process.hpp"
#include "mesh/mesh_format.hpp"
#include "mesh/weld.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <numeric>
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

/// Vertices that only points and lines of the part use are left out.
std::vector<char> vertices_of_surface(const aiMesh& part) {
  std::vector<char> kept(part.mNumVertices, 1);
  for (const bool surface : {false, true})
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if ((face.mNumIndices > 2) != surface) continue;
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (face.mIndices[k] < kept.size()) kept[face.mIndices[k]] = surface ? 1 : 0;
    }
  return kept;
}

/// Appends texture coordinates of all vertices and returns the index of the first, -1 if there are
/// none.
int append_uvs(const aiMesh& part, PolygonMesh& mesh) {
  if (!part.HasTextureCoords(0)) return -1;
  const int first = static_cast<int>(mesh.uvs.size());
  for (unsigned v = 0; v < part.mNumVertices; ++v)
    mesh.uvs.push_back({part.mTextureCoords[0][v].x, part.mTextureCoords[0][v].y});
  return first;
}

/// Appends the vertices that are kept and returns the index of each.
std::vector<int> append_vertices(const aiMesh& part, const Mat3& linear, const Vec3& shift,
                                 PolygonMesh& mesh) {
  const bool plain = linear.isIdentity(0) && shift.isZero(0);
  const std::vector<char> kept = vertices_of_surface(part);
  std::vector<int> index(part.mNumVertices, -1);
  for (unsigned v = 0; v < part.mNumVertices; ++v) {
    if (!kept[v]) continue;
    index[v] = static_cast<int>(mesh.vertices.size());
    const aiVector3D& p = part.mVertices[v];
    // Without a transform nothing is computed: a single NaN stays a single one.
    const Vec3 position(p.x, p.y, p.z);
    mesh.vertices.push_back(plain ? position : Vec3(linear * position + shift));
  }
  return index;
}

void append_mesh(const aiMesh& part, const Eigen::Matrix4d& transform, PolygonMesh& mesh) {
  const Mat3 linear = transform.topLeftCorner<3, 3>();
  const std::vector<int> index =
      append_vertices(part, linear, transform.topRightCorner<3, 1>(), mesh);
  const int first_uv = append_uvs(part, mesh);
  // A mirroring transform turns counter-clockwise into clockwise.
  const bool mirrored = linear.determinant() < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    const unsigned n = face.mNumIndices;
    if (n < 3) continue;
    for (unsigned k = 0; k < n; ++k) {
      const unsigned v = face.mIndices[mirrored ? (n - k) % n : k];
      const bool exists = v < index.size();
      mesh.corners.push_back(exists ? index[v] : -1);
      mesh.corner_uvs.push_back(exists && first_uv >= 0 ? first_uv + static_cast<int>(v) : -1);
    }
    mesh.end_face();
  }
}

void append_node(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent,
                 PolygonMesh& mesh) {
  const Eigen::Matrix4d transform = parent * to_eigen(node.mTransformation);
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    append_mesh(*scene.mMeshes[node.mMeshes[m]], transform, mesh);
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    append_node(scene, *node.mChildren[c], transform, mesh);
}

/// A file that repeats the corners of every face (STL, COLLADA) carries no vertex order worth
/// keeping: join equal positions. An indexed mesh stays as it is. assimp's own joining compares
/// with an absolute tolerance of 1e-5, which is not small for a mesh in metres.
void join_soup(PolygonMesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  if (n != mesh.corners.size()) return;
  for (const Vec3& v : mesh.vertices)
    if (!v.allFinite()) return;
  std::vector<int> all(n), index(n);
  std::iota(all.begin(), all.end(), 0);
  std::vector<char> seen(n, 0);
  for (int v : mesh.corners) {
    if (v < 0 || seen[v]) return;  // not each vertex once
    seen[v] = 1;
  }
  const std::vector<int> first = first_at_position(mesh.vertices, std::move(all));
  std::vector<Vec3> joined;
  for (std::size_t v = 0; v < n; ++v) {
    if (first[v] == static_cast<int>(v)) {
      index[v] = static_cast<int>(joined.size());
      joined.push_back(mesh.vertices[v]);
    }
    index[v] = index[first[v]];
  }
  for (int& v : mesh.corners) v = index[v];
  mesh.vertices = std::move(joined);
}

PolygonMesh import(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                  aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                  aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS);
  const aiScene* scene =
      importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw Error(ErrorCode::invalid_input, importer.GetErrorString());
  PolygonMesh mesh;
  append_node(*scene, *scene->mRootNode, Eigen::Matrix4d::Identity(), mesh);
  join_soup(mesh);
  return mesh;
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
    const PolygonMesh mesh = import(path);
    std::string bytes(1, kMesh);
    append_raw(bytes, mesh.vertices);
    append_raw(bytes, mesh.corners);
    append_raw(bytes, mesh.starts);
    append_raw(bytes, mesh.uvs);
    append_raw(bytes, mesh.corner_uvs);
    return bytes;
  } catch (const std::bad_alloc&) {
    return kCause + std::string("it asks for more memory than there is");
  } catch (const std::exception& e) {
    return kCause + std::string(e.what());
  }
}

/// Much more than any reader needs for an intact file of the size, compressed ones included.
IsolatedLimits limits_for(const std::string& path) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  const double bytes = unknown ? 0.0 : static_cast<double>(size);
  IsolatedLimits limits;
  limits.cpu_seconds = static_cast<int>(std::min(2 + bytes / 250000, 100000.0));
  limits.wall_seconds = 20 + 10.0 * limits.cpu_seconds;
  limits.memory = (std::size_t{1} << 30) + static_cast<std::size_t>(100 * bytes);
  return limits;
}

[[noreturn]] void refuse(const std::string& path, const std::string& cause) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (cause.find("No suitable reader found") != cause.npos)
    throw Error(ErrorCode::invalid_input,
                unsupported_text(path, extension.empty() ? "this" : extension));
  throw Error(ErrorCode::invalid_input, path + ": the mesh cannot be read: " + cause);
}

/// assimp 5.2 crashes at 3MF files with a preview or textures, which most programs write.
[[noreturn]] void refuse_unfinished(const std::string& path, const std::string& failure) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (is_whole_zip(bytes))
    throw Error(ErrorCode::invalid_input,
                unsupported_text(path, "this kind of compressed file (3MF with a preview, ...)"));
  refuse(path, "the file is damaged, its reader gave up (" + failure + ")");
}

}  // namespace

PolygonMesh read_with_assimp(const std::string& path) {
  const IsolatedResult result =
      run_isolated([&] { return import_to_bytes(path); }, limits_for(path));
  if (!result.finished) refuse_unfinished(path, result.failure);
  require(!result.output.empty(), "the reader process answers");
  if (result.output[0] == kCause) refuse(path, result.output.substr(1));
  PolygonMesh mesh;
  std::size_t position = 1;
  take_raw(result.output, position, mesh.vertices);
  take_raw(result.output, position, mesh.corners);
  take_raw(result.output, position, mesh.starts);
  take_raw(result.output, position, mesh.uvs);
  take_raw(result.output, position, mesh.corner_uvs);
  require(!mesh.starts.empty() && mesh.starts.back() == mesh.corners.size(),
          "the reader process sends a whole mesh");
  return mesh;
}

}  // namespace bem
