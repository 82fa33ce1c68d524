#include "rigid_bodies.hpp"

#include "mesh/self_intersection.hpp"

#include <algorithm>

namespace bem::test {
namespace {

Mat3 rotation_of(const Vec3& v) {
  return v.norm() > 0 ? turned(v, v.norm()) : Mat3(Mat3::Identity());
}

}  // namespace

void RigidBodies::step() {
  if (!detector_) detector_ = std::make_unique<CollisionDetector>(surfaces_, planes, options);
  start_ = positions(false);
  for (Body& b : bodies_) {
    b.velocity += time_step * gravity;
    b.end = b.position + time_step * b.velocity;
    b.end_rotation = rotation_of(time_step * b.spin) * b.rotation;
  }
  contacts_.clear();
  for (rounds = 1; rounds <= 30; ++rounds) {
    end_ = positions(true);
    if (!add_contacts()) break;
    project();
  }
  for (Body& b : bodies_) {
    b.velocity = (b.end - b.position) / time_step;
    const Eigen::AngleAxisd turn(b.end_rotation * b.rotation.transpose());
    b.spin = turn.angle() / time_step * turn.axis();
    b.position = b.end;
    b.rotation = b.end_rotation;
  }
  held = 0;
  for (const auto& [key, c] : contacts_) held += c.impulse > 0;
}

double RigidBodies::penetration() const {
  const auto at = positions(false);
  double deepest = 0;
  for (std::size_t i = 0; i < surfaces_.size(); ++i) {
    for (std::size_t j = 0; j < surfaces_.size(); ++j)
      if (i != j && (i < bodies_.size() || j < bodies_.size()))
        deepest =
            std::max(deepest, deepest_penetration(at[i], surfaces_[j].triangles, at[j]).depth);
    for (const CollisionPlane& plane : planes)
      if (i < bodies_.size()) deepest = std::max(deepest, deepest_penetration(at[i], plane).depth);
  }
  return deepest;
}

bool RigidBodies::cut_deeper_than(double depth) const {
  TriangleMesh all;
  const auto add = [&](const TriangleMesh& mesh, const std::vector<Vec3>& at, const Vec3& centre,
                       bool shrunk) {
    const int offset = static_cast<int>(all.vertices.size());
    for (const Vec3& p : at)
      all.vertices.push_back(shrunk ? Vec3(p - 2 * depth * (p - centre).normalized()) : p);
    for (Triangle t : mesh.triangles) {
      for (int& v : t) v += offset;
      all.triangles.push_back(t);
    }
  };
  const auto at = positions(false);
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    add(bodies_[i].mesh, at[i], bodies_[i].position, true);
  for (std::size_t i = 0; i < obstacles_.size(); ++i)
    add(obstacles_[i], at[bodies_.size() + i], Vec3::Zero(), false);
  return find_self_intersections(all).count > 0;
}

std::vector<std::vector<Vec3>> RigidBodies::positions(bool at_end) const {
  std::vector<std::vector<Vec3>> result;
  for (const Body& b : bodies_)
    result.push_back(
        moved(b.mesh.vertices, at_end ? b.end : b.position, at_end ? b.end_rotation : b.rotation));
  for (const TriangleMesh& mesh : obstacles_) result.push_back(mesh.vertices);
  return result;
}

bool RigidBodies::add_contacts() {
  std::vector<SurfaceMotion> motions;
  for (std::size_t i = 0; i < start_.size(); ++i) motions.push_back({&start_[i], &end_[i]});
  bool violated = false;
  for (const Contact& c : detector_->detect(motions)) {
    contacts_[c.key].contact = c;
    violated = violated || c.gap_end < -0.5 * options.tolerance;
  }
  return violated;
}

Vec3 RigidBodies::place(const SurfacePoint& p, const Contact& c) const {
  if (p.count == 0) return c.point;
  if (p.surface >= static_cast<int>(bodies_.size()))
    return p.place(obstacles_[p.surface - bodies_.size()].vertices);
  const Body& b = bodies_[p.surface];
  return b.end + b.end_rotation * p.place(b.mesh.vertices);
}

double RigidBodies::mobility(const SurfacePoint& p, const Vec3& at, const Vec3& n) const {
  if (p.surface >= static_cast<int>(bodies_.size())) return 0;
  const Body& b = bodies_[p.surface];
  return 1 + (at - b.end).cross(n).squaredNorm() / b.inertia;
}

void RigidBodies::push(const SurfacePoint& p, const Vec3& at, const Vec3& impulse) {
  if (p.surface >= static_cast<int>(bodies_.size())) return;
  Body& b = bodies_[p.surface];
  const Vec3 turn = (at - b.end).cross(impulse) / b.inertia;
  b.end += impulse;
  b.end_rotation = rotation_of(turn) * b.end_rotation;
}

void RigidBodies::project() {
  for (int sweep = 0; sweep < 3000; ++sweep) {
    double violation = 0;
    for (auto& [key, h] : contacts_) {
      const Contact& c = h.contact;
      const Vec3 a = place(c.a, c), b = place(c.b, c);
      const double gap = c.normal.dot(a - b);
      const double impulse = std::max(
          0.0, h.impulse - gap / (mobility(c.a, a, c.normal) + mobility(c.b, b, c.normal)));
      violation = std::max(violation, -gap);
      push(c.a, a, (impulse - h.impulse) * c.normal);
      push(c.b, b, (h.impulse - impulse) * c.normal);
      h.impulse = impulse;
    }
    if (violation < 0.1 * options.tolerance) return;
  }
}

}  // namespace bem::test
