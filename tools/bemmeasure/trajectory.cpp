#include "trajectory.hpp"

#include "mesh/surface.hpp"

namespace bem {
namespace {

/// The triangles of nodes of a closed surface; a mesh that is none does not come from bemsim.
std::vector<Triangle> outward(TriangleMesh mesh, const std::string& path) {
  try {
    return make_surface(std::move(mesh), path).nodes.triangles;
  } catch (const Error& e) {
    throw Error(ErrorCode::archive, e.what());
  }
}

}  // namespace

Trajectory::Trajectory(const std::string& path, const Scene& scene)
    : file_(path, ErrorCode::archive) {
  for (const BodySpec& body : scene.bodies) {
    names_.push_back(body.name);
    triangles_.push_back(file_.faces(body.name));
    // Outward, whatever the file of the mesh said.
    if (!times().empty()) triangles_.back() = outward(this->body(names_.size() - 1, 0), path);
  }
}

TriangleMesh Trajectory::body(std::size_t b, std::size_t k) const {
  TriangleMesh mesh;
  mesh.triangles = triangles_[b];
  mesh.vertices.resize(file_.vertices(names_[b]));
  file_.read(names_[b], "/positions", {mesh.vertices.size(), 3}, k, mesh.vertices.data()->data());
  return mesh;
}

}  // namespace bem
