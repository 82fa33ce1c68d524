#include "contact/collision_scene.hpp"

#include "contact/bounding_tree.hpp"
#include "contact/penetration.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <memory>

namespace bem {
namespace {

double combine(FrictionCombine how, double a, double b) {
  switch (how) {
    case FrictionCombine::max:
      return std::max(a, b);
    case FrictionCombine::min:
      return std::min(a, b);
    case FrictionCombine::average:
      return 0.5 * (a + b);
    case FrictionCombine::multiply:
      return a * b;
  }
  return 0;
}

CollisionDetector make_detector(const Scene& scene, const std::vector<Body>& bodies,
                                const std::vector<ObstacleMesh>& obstacles,
                                const std::vector<std::pair<int, int>>& joined_bodies) {
  std::vector<CollisionSurface> surfaces;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body& body : bodies) {
    CollisionSurface s;
    s.triangles = body.model().geometry.nodes.triangles;
    s.vertex_count = static_cast<int>(body.model().nodes());
    s.self_contact = scene.contact.self && !body.is_rigid();
    smallest = std::min(smallest, body.model().geometry.extent);
    surfaces.push_back(std::move(s));
  }
  for (const ObstacleMesh& o : obstacles) {
    CollisionSurface s;
    s.triangles = o.mesh.triangles;
    s.vertex_count = static_cast<int>(o.mesh.vertices.size());
    s.prescribed = true;
    surfaces.push_back(std::move(s));
  }
  std::vector<CollisionPlane> planes;
  for (const ObstacleSpec& o : scene.obstacles)
    if (const auto* plane = std::get_if<PlaneObstacle>(&o.shape))
      planes.push_back({plane->point, plane->normal});
  CollisionOptions options;
  constexpr double kMargin = 1e-3, kRecoveryDepth = 5e-3;  // of the smallest body
  options.tolerance = scene.contact.tolerance;
  options.margin = std::max(kMargin * smallest, 2 * options.tolerance);
  options.recovery_depth = std::max(kRecoveryDepth * smallest, 2 * options.tolerance);
  options.ignored_pairs = joined_bodies;
  return CollisionDetector(std::move(surfaces), std::move(planes), std::move(options));
}

}  // namespace

CollisionScene::CollisionScene(const Scene& scene, const std::vector<Body>& bodies,
                               std::vector<ObstacleMesh> obstacles,
                               const std::vector<std::pair<int, int>>& joined_bodies)
    : scene_(scene),
      bodies_(bodies),
      obstacles_(std::move(obstacles)),
      detector_(make_detector(scene, bodies, obstacles_, joined_bodies)) {
  for (const Body& body : bodies) {
    smallest_ = std::min(smallest_, body.model().geometry.extent);
    friction_.push_back(body.spec().friction);
  }
  for (const ObstacleMesh& o : obstacles_) friction_.push_back(o.spec->friction);
  for (const ObstacleSpec& o : scene.obstacles)
    if (std::holds_alternative<PlaneObstacle>(o.shape)) friction_.push_back(o.friction);
  start_.resize(bodies.size() + obstacles_.size());
  end_.resize(start_.size());
}

void CollisionScene::begin_step(double t, double dt) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) start_[b] = bodies_[b].node_positions();
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const auto& shape = std::get<MeshObstacle>(obstacles_[o].spec->shape);
    const std::size_t s = bodies_.size() + o;
    const auto place = [&](double time, std::vector<Vec3>& out) {
      const RigidMotion motion = motion_at(shape.motion, time);
      out.clear();
      for (const Vec3& x : obstacles_[o].mesh.vertices)
        out.push_back(motion.apply(shape.position + x));
    };
    if (shape.motion.empty() && !start_[s].empty()) continue;
    place(t, start_[s]);
    place(t + dt, end_[s]);
  }
}

std::vector<Triangle> CollisionScene::triangles(std::size_t surface) const {
  return surface < bodies_.size() ? bodies_[surface].model().geometry.nodes.triangles
                                  : obstacles_[surface - bodies_.size()].mesh.triangles;
}

std::vector<CollisionScene::Overlap> CollisionScene::overlaps() {
  begin_step(0, 0);
  std::vector<Overlap> out;
  std::vector<BoundingBox> boxes;
  for (const std::vector<Vec3>& surface : start_) boxes.push_back(bounding_box(surface));
  std::vector<std::unique_ptr<PenetrableSurface>> surfaces(start_.size());
  const auto depth = [&](int a, int b) {
    if (!surfaces[b]) surfaces[b] = std::make_unique<PenetrableSurface>(triangles(b), start_[b]);
    return surfaces[b]->is_closed() ? surfaces[b]->deepest(start_[a]).depth : 0.0;
  };
  const auto add = [&](std::size_t a, const std::string& b, double by) {
    if (by > scene_.contact.tolerance) out.push_back({bodies_[a].name(), b, by});
  };
  const auto body_count = static_cast<int>(bodies_.size());
  for (const auto& [a, b] : overlapping_pairs(boxes))
    if (a < body_count && detector_.is_allowed(a, b))
      add(a, b < body_count ? bodies_[b].name() : obstacles_[b - body_count].spec->name,
          std::max(depth(a, b), depth(b, a)));
  for (std::size_t a = 0; a < bodies_.size(); ++a)
    for (const ObstacleSpec& o : scene_.obstacles)
      if (const auto* plane = std::get_if<PlaneObstacle>(&o.shape))
        add(a, o.name,
            deepest_penetration(start_[a], CollisionPlane{plane->point, plane->normal}).depth);
  return out;
}

ContactPair CollisionScene::pair_of(const Contact& contact) const {
  const auto bodies = static_cast<int>(bodies_.size());
  ContactPair pair;
  pair.contact = contact;
  if (contact.a.surface < bodies)
    pair.body_a = contact.a.surface;
  else
    pair.obstacle_a = contact.a.place(end_[contact.a.surface]);
  if (contact.b.surface < bodies)
    pair.body_b = contact.b.surface;
  else
    pair.obstacle_b = contact.point;
  pair.friction = combine(scene_.contact.friction_combine, friction_[contact.a.surface],
                          friction_[contact.b.surface]);
  return pair;
}

std::vector<ContactPair> CollisionScene::detect_at_rest() {
  for (std::size_t b = 0; b < bodies_.size(); ++b) end_[b] = start_[b];
  return detect();
}

std::vector<ContactPair> CollisionScene::detect(std::vector<Body>& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) end_[b] = bodies[b].end_positions();
  return detect();
}

std::vector<ContactPair> CollisionScene::detect() {
  std::vector<SurfaceMotion> motions;
  for (std::size_t s = 0; s < start_.size(); ++s) motions.push_back({&start_[s], &end_[s]});
  std::vector<ContactPair> pairs;
  for (const Contact& c : detector_.detect(motions)) pairs.push_back(pair_of(c));
  return pairs;
}

}  // namespace bem
