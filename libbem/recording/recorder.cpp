#include "recording/recorder.hpp"

#include "mesh/mesh_digest.hpp"
#include "recording/body_series.hpp"

#include <algorithm>

namespace bem {
namespace {

const FrameQuantity kVelocities{"velocities", "m/s", 3}, kTractions{"tractions", "Pa", 3},
    kStress{"stress", "Pa", 6}, kVonMises{"von_mises", "Pa", 1};

TrajectoryBody shown_surface(const ShownBody& body) {
  const TriangleMesh& mesh = body.geometry->input;
  TrajectoryBody out{body.spec->name, mesh.vertices.size(), mesh.triangles, {}, mesh.vertices};
  if (!body.render) return out;
  out.name = simulation_name(out.name);
  out.surface = TrajectorySurface::simulation;
  return out;
}

TrajectoryBody shown_mesh(const ShownBody& body) {
  const TriangleMesh& mesh = body.render->mesh()->triangles;
  const TrajectorySurface surface =
      body.shows_surface ? TrajectorySurface::only : TrajectorySurface::render;
  return {body.spec->name, mesh.vertices.size(), mesh.triangles, {}, mesh.vertices,
          surface,         body.render->mesh()};
}

TrajectoryObstacle shown_obstacle(const ShownObstacle& obstacle) {
  TrajectoryObstacle out{obstacle.spec->name, {}};
  if (const auto* plane = std::get_if<PlaneObstacle>(&obstacle.spec->shape)) {
    out.plane = ObstaclePlane{plane->point, plane->normal};
    return out;
  }
  const ObstacleSurface& surface = *obstacle.surface;
  out.vertices = surface.solid.vertices;
  out.triangles = surface.solid.triangles;
  const TriangleMesh& layers = surface.sheet.layers;
  const int first = static_cast<int>(out.vertices.size());
  out.vertices.insert(out.vertices.end(), layers.vertices.begin(), layers.vertices.end());
  for (std::size_t t = 0; t < layers.triangles.size(); t += 2) {  // one side of each
    Triangle triangle = layers.triangles[t];
    for (int& v : triangle) v += first;
    out.triangles.push_back(triangle);
  }
  return out;
}

}  // namespace

Recorder::Recorder(const Scene& scene, std::vector<ShownBody> bodies,
                   const std::vector<ShownObstacle>& obstacles, std::string program)
    : scene_(scene), bodies_(std::move(bodies)) {
  contents_.program = std::move(program);
  contents_.scene = scene.text;
  contents_.time_step = scene.time_step;
  contents_.contacts = writes(OutputField::contacts);
  stress_.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    add_body(bodies_[i], i);
    if (writes(OutputField::stress))
      stress_[i] =
          std::make_unique<SurfaceStress>(bodies_[i].geometry->nodes, *bodies_[i].material);
  }
  for (const ShownObstacle& o : obstacles) {
    contents_.obstacles.push_back(shown_obstacle(o));
    contents_.obstacles.back().index = bodies_.size() + (contents_.obstacles.size() - 1);
  }
}

bool Recorder::writes(OutputField field) const {
  const auto& fields = scene_.output.fields;
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

bool Recorder::writes_simulated_surface(const ShownBody& body) const {
  if (body.shows_surface) return false;
  return !body.render || scene_.output.surface == OutputSurface::both;
}

void Recorder::add_body(const ShownBody& body, std::size_t index) {
  const auto add = [&](TrajectoryBody shown) {
    if (writes(OutputField::velocities)) shown.fields.push_back(kVelocities);
    if (writes(OutputField::tractions)) shown.fields.push_back(kTractions);
    if (writes(OutputField::stress)) {
      shown.fields.push_back(kStress);
      shown.fields.push_back(kVonMises);
    }
    shown.series = body_series(body.energies);
    shown.index = index;
    shown.mass = body.geometry->mass.mass;
    shown.archive_digest = body.archive_digest;
    shown.mesh_digest = mesh_digest(body.geometry->input);
    contents_.bodies.push_back(std::move(shown));
  };
  if (body.render) add(shown_mesh(body));
  if (writes_simulated_surface(body)) add(shown_surface(body));
}

}  // namespace bem
