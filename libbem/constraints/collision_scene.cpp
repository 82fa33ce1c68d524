#include "constraints/collision_scene.hpp"

#include "collision/moving_surface.hpp"
#include "collision/penetration.hpp"
#include "collision/surface_overlap.hpp"
#include "dynamics/body_output.hpp"
#include "mesh/bounding_tree.hpp"
#include "mesh/closest_points.hpp"
#include "scene/motion.hpp"

#include <algorithm>
#include <memory>
#include <numeric>

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

}  // namespace

CollisionScene::CollisionScene(const Scene& scene, const std::vector<Body>& bodies,
                               const std::vector<ObstacleMesh>& obstacles,
                               const std::vector<std::pair<int, int>>& joined_bodies,
                               const ContactTolerances& tolerances)
    : scene_(scene),
      bodies_(bodies),
      tolerances_(tolerances),
      obstacles_(parts_of(obstacles, tolerances.sheet_offset)),
      detector_(make_detector(joined_bodies)) {
  for (const Body& body : bodies) friction_.push_back(body.spec().friction);
  for (const ObstaclePart& o : obstacles_) friction_.push_back(o.spec->friction);
  for (const ObstacleSpec& o : scene.obstacles)
    if (std::holds_alternative<PlaneObstacle>(o.shape)) friction_.push_back(o.friction);
  in_scene_ = places_in_scene();
  start_.resize(bodies.size() + obstacles_.size());
  end_.resize(start_.size());
}

std::vector<CollisionScene::ObstaclePart> CollisionScene::parts_of(
    const std::vector<ObstacleMesh>& obstacles, double sheet_offset) {
  std::vector<ObstaclePart> parts;
  for (const ObstacleMesh& o : obstacles) {
    if (!o.surface.solid.triangles.empty()) parts.push_back({o.spec, o.surface.solid, {}});
    if (o.surface.sheet_triangles() == 0) continue;
    TriangleMesh layers = o.surface.sheet.layers;
    for (std::size_t v = 0; v < layers.vertices.size(); ++v)
      layers.vertices[v] += sheet_offset * o.surface.sheet.offsets[v];
    parts.push_back({o.spec, std::move(layers), o.surface.sheet.rim, 2 * sheet_offset});
  }
  return parts;
}

CollisionDetector CollisionScene::make_detector(
    const std::vector<std::pair<int, int>>& joined_bodies) const {
  std::vector<CollisionSurface> surfaces;
  for (const Body& body : bodies_) {
    CollisionSurface s;
    s.triangles = body.model().geometry.nodes.triangles;
    s.vertex_count = static_cast<int>(body.model().nodes());
    s.self_contact = scene_.contact.self && !body.is_rigid();
    surfaces.push_back(std::move(s));
  }
  for (const ObstaclePart& o : obstacles_) {
    CollisionSurface s;
    s.triangles = o.mesh.triangles;
    s.triangles.insert(s.triangles.end(), o.rim.begin(), o.rim.end());
    s.vertex_count = static_cast<int>(o.mesh.vertices.size());
    s.prescribed = true;
    s.recovery_depth = o.recovery_depth;
    surfaces.push_back(std::move(s));
  }
  std::vector<CollisionPlane> planes;
  for (const ObstacleSpec& o : scene_.obstacles)
    if (const auto* plane = std::get_if<PlaneObstacle>(&o.shape))
      planes.push_back({plane->point, plane->normal});
  return CollisionDetector(std::move(surfaces), std::move(planes),
                           {tolerances_.detection, joined_bodies});
}

void CollisionScene::begin_step(double t, double dt, const std::vector<ContactKey>& broken) {
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    start_[b] = BodyOutput(bodies_[b]).node_positions();
  for (std::size_t o = 0; o < obstacles_.size(); ++o) {
    const auto& shape = std::get<MeshObstacle>(obstacles_[o].spec->shape);
    const std::size_t s = bodies_.size() + o;
    if (shape.motion.empty() && !start_[s].empty()) continue;
    start_[s] = placed_at(shape, obstacles_[o].mesh.vertices, t);
    end_[s] = placed_at(shape, obstacles_[o].mesh.vertices, t + dt);
  }
  find_pressed(broken);
}

void CollisionScene::find_pressed(const std::vector<ContactKey>& broken) {
  const auto limit_of = [&](int surface) {
    const int obstacle = surface - static_cast<int>(bodies_.size());
    const double own = obstacle >= 0 && obstacle < static_cast<int>(obstacles_.size())
                           ? obstacles_[obstacle].recovery_depth
                           : std::numeric_limits<double>::infinity();
    return std::min(own, tolerances_.detection.recovery_depth);
  };
  pressed_.clear();
  deepest_ = 0;
  for (ContactKey key : broken) {
    const double d = depth(key);
    if (d <= std::min(limit_of(key.surface_a), limit_of(key.surface_b))) continue;
    key.view = 0;
    pressed_.push_back(key);
    deepest_ = std::max(deepest_, d);
  }
  std::sort(pressed_.begin(), pressed_.end());
  pressed_.erase(std::unique(pressed_.begin(), pressed_.end()), pressed_.end());
}

/// How far the sides of a contact are in each other at the start of the step [m]. Planes have no
/// limit of their own.
double CollisionScene::depth(const ContactKey& key) const {
  if (key.kind == ContactKind::vertex_plane) return 0;
  const std::vector<Vec3>&a = start_[key.surface_a], &b = start_[key.surface_b];
  if (key.kind == ContactKind::edge_edge) {
    const auto& e = detector_.edge(key.surface_a, key.feature_a);
    const auto& f = detector_.edge(key.surface_b, key.feature_b);
    const LinePair lines = closest_on_lines(a[e[0]], a[e[1]], b[f[0]], b[f[1]]);
    return (a[e[0]] + lines.s * (a[e[1]] - a[e[0]]) - b[f[0]] - lines.u * (b[f[1]] - b[f[0]]))
        .norm();
  }
  const Triangle& t = detector_.triangle(key.surface_b, key.feature_b);
  return -unit_normal(b[t[0]], b[t[1]], b[t[2]]).dot(a[key.feature_a] - b[t[0]]);
}

const std::vector<Triangle>& CollisionScene::triangles(std::size_t surface) const {
  return surface < bodies_.size() ? bodies_[surface].model().geometry.nodes.triangles
                                  : obstacles_[surface - bodies_.size()].mesh.triangles;
}

const std::string& CollisionScene::name(std::size_t surface) const {
  return surface < bodies_.size() ? bodies_[surface].name()
                                  : obstacles_[surface - bodies_.size()].spec->name;
}

std::vector<int> CollisionScene::places_in_scene() const {
  const int bodies = static_cast<int>(bodies_.size());
  std::vector<int> out(bodies);
  std::iota(out.begin(), out.end(), 0);
  const auto add = [&](const ObstacleSpec& o) {
    out.push_back(bodies + static_cast<int>(&o - scene_.obstacles.data()));
  };
  for (const ObstaclePart& part : obstacles_) add(*part.spec);
  for (const ObstacleSpec& o : scene_.obstacles)
    if (std::holds_alternative<PlaneObstacle>(o.shape)) add(o);
  return out;
}

std::vector<CollisionScene::Overlap> CollisionScene::overlaps() {
  begin_step(0, 0);
  std::vector<Overlap> out;
  std::vector<BoundingBox> boxes;
  for (const std::vector<Vec3>& surface : start_) boxes.push_back(bounding_box(surface));
  std::vector<std::unique_ptr<SignedDistance>> solids(start_.size());
  const auto solid = [&](std::size_t s) -> const SignedDistance& {
    if (!solids[s]) solids[s] = std::make_unique<SignedDistance>(triangles(s), start_[s]);
    return *solids[s];
  };
  const auto body_count = static_cast<int>(bodies_.size());
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    if (a >= body_count || !detector_.is_allowed(a, b)) continue;
    const double depth = surface_overlap(solid(a), solid(b), tolerances_.tolerance);
    if (depth > 0) out.push_back({bodies_[a].name(), name(b), depth});
  }
  for (std::size_t a = 0; a < bodies_.size(); ++a)
    for (const ObstacleSpec& o : scene_.obstacles) {
      const auto* plane = std::get_if<PlaneObstacle>(&o.shape);
      if (!plane) continue;
      const double depth =
          deepest_penetration(start_[a], CollisionPlane{plane->point, plane->normal}).depth;
      if (depth > tolerances_.tolerance) out.push_back({bodies_[a].name(), o.name, depth});
    }
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
  pair.in_scene_a = in_scene_[contact.a.surface];
  pair.in_scene_b = in_scene_[contact.b.surface];
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
  const std::vector<Contact> contacts = detector_.detect(motions, pressed_, deepest_);
  const bool unmet = std::any_of(contacts.begin(), contacts.end(), [&](const Contact& c) {
    return !c.backward && c.gap_end < -tolerances_.tolerance;
  });
  for (const Contact& c : contacts)
    if (!c.backward || !unmet) pairs.push_back(pair_of(c));
  return pairs;
}

}  // namespace bem
