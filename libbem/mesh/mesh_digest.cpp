#include "mesh/mesh_digest.hpp"

#include "files/digest.hpp"

namespace bem {

std::string mesh_digest(const TriangleMesh& mesh) {
  std::string bytes;
  const auto add = [&](const auto& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  };
  add(mesh.vertices);
  add(mesh.triangles);
  return digest_of(bytes);
}

}  // namespace bem
