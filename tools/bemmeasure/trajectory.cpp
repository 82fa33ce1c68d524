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
    names_.push_back(simulated(body.name));
    triangles_.push_back(file_.faces(names_.back()));
    // Outward, whatever the file of the mesh said.
    if (!times().empty()) triangles_.back() = outward(this->body(names_.size() - 1, 0), path);
  }
}

/// The name under which the trajectory has the simulated surface of a body.
std::string Trajectory::simulated(const std::string& body) const {
  if (!file_.is_render_mesh(body)) return body;
  if (!file_.has_body(simulation_name(body)))
    throw Error(ErrorCode::archive,
                file_.path() + ": of the body " + in_quotes(body) +
                    " it has the render mesh alone, and only simulated surfaces can be measured: "
                    "write them with \"output\": {\"surface\": \"both\"}");
  return simulation_name(body);
}

TriangleMesh Trajectory::body(std::size_t b, std::size_t k) const {
  TriangleMesh mesh;
  mesh.triangles = triangles_[b];
  mesh.vertices.resize(file_.vertices(names_[b]));
  file_.read(names_[b], "/positions", {mesh.vertices.size(), 3}, k, mesh.vertices.data()->data());
  return mesh;
}

}  // namespace bem
