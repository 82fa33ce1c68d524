#include "trajectory.hpp"

#include "mesh/surface.hpp"

namespace bem {

Trajectory::Trajectory(const std::string& path, const Scene& scene)
    : file_(Hdf5File::open(path, ErrorCode::archive)), times_(file_.read<double>("/time")) {
  for (const BodySpec& body : scene.bodies) {
    names_.push_back("/bodies/" + body.name);
    const std::string faces = names_.back() + "/faces";
    const std::vector<std::int32_t> corners = file_.read<std::int32_t>(faces);
    std::vector<Triangle> triangles(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i) triangles[i / 3][i % 3] = corners[i];
    triangles_.push_back(std::move(triangles));
    // Outward, whatever the file of the mesh said.
    if (!times_.empty())
      triangles_.back() = make_surface(this->body(names_.size() - 1, 0), path).nodes.triangles;
  }
}

TriangleMesh Trajectory::body(std::size_t b, std::size_t k) const {
  const std::string positions = names_[b] + "/positions";
  TriangleMesh mesh;
  mesh.triangles = triangles_[b];
  mesh.vertices.resize(file_.dims(positions)[1]);
  file_.read_rows(positions, k, 1, mesh.vertices.front().data());
  return mesh;
}

}  // namespace bem
