#include "convergence/motion_record.hpp"

#include "convergence/rigid_fit.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/mesh_io.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr std::size_t kMostPoints = 2000, kLeastPoints = 20;  // of a scene, of a body

void append(std::vector<double>& values, const Vec3& v, double factor) {
  for (int k = 0; k < 3; ++k) values.push_back(factor * v[k]);
}

}  // namespace

FollowedPoints follow_points(const std::string& mesh_path, double mesh_scale, std::size_t most) {
  TriangleMesh mesh = read_mesh(mesh_path);
  for (Vec3& x : mesh.vertices) x *= mesh_scale;
  FollowedPoints out;
  const std::vector<double> areas = vertex_areas(mesh);
  const std::size_t count = mesh.vertices.size(), stride = (count + most - 1) / most;
  double area = 0;
  for (std::size_t v = 0; v < count; v += stride) {
    if (areas[v] == 0) continue;
    out.vertices.push_back(static_cast<int>(v));
    out.rest.push_back(mesh.vertices[v]);
    out.weights.push_back(areas[v]);
    area += areas[v];
  }
  for (double& weight : out.weights) weight /= area;
  out.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  return out;
}

std::vector<std::shared_ptr<const FollowedPoints>> followed_points(const Scene& scene) {
  const std::size_t most = std::max(kMostPoints / scene.bodies.size(), kLeastPoints);
  std::map<std::pair<std::string, double>, std::shared_ptr<const FollowedPoints>> known;
  std::vector<std::shared_ptr<const FollowedPoints>> out;
  for (const BodySpec& body : scene.bodies) {
    const BodySource& source = *body.source;
    auto& points = known[{source.mesh.resolved, source.mesh_scale}];
    if (!points)
      points = std::make_shared<const FollowedPoints>(at_place(source.mesh.location, [&] {
        return follow_points(source.mesh.resolved, source.mesh_scale, most);
      }));
    out.push_back(points);
  }
  return out;
}

MotionRecorder::MotionRecorder(std::vector<std::shared_ptr<const FollowedPoints>> points,
                               const Simulation& simulation, std::size_t times)
    : points_(std::move(points)),
      start_(points_.size()),
      motions_(points_.size()),
      times_(static_cast<double>(times)) {
  std::map<std::pair<const BodyModel*, const FollowedPoints*>,
           std::shared_ptr<const SurfaceBinding>>
      known;
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const BodyModel& model = simulation.bodies()[b].model();
    auto& binding = known[{&model, points_[b].get()}];
    if (!binding)
      binding = std::make_shared<const SurfaceBinding>(surface_at_rest(model.geometry),
                                                       *points_[b]->mesh);
    bindings_.push_back(binding);
  }
}

void MotionRecorder::record(const Simulation& simulation) {
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const SurfaceBinding& binding = *bindings_[b];
    const std::vector<Vec3> all =
        binding.points(binding.pose(BodyOutput(simulation.bodies()[b]).node_positions()));
    std::vector<Vec3> positions;
    for (int v : points_[b]->vertices) positions.push_back(all[v]);
    record(b, positions);
  }
}

void MotionRecorder::record(std::size_t body, const std::vector<Vec3>& positions) {
  const FollowedPoints& points = *points_[body];
  BodyMotion& motion = motions_[body];
  if (start_[body].empty()) start_[body] = positions;
  const RigidFit fit = fit_rigid_motion(points.rest, positions, points.weights);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double factor = std::sqrt(points.weights[i] / times_);
    const Vec3 arm = points.rest[i] - fit.rest_centre;
    append(motion.position, positions[i], factor);
    append(motion.rigid, fit.centre + fit.rotation * arm, factor);
    append(motion.deformation, fit.rotation.transpose() * (positions[i] - fit.centre) - arm,
           factor);
    append(motion.path, positions[i] - start_[body][i], factor);
  }
}

}  // namespace bem
