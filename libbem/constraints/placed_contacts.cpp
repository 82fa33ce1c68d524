#include "constraints/placed_contacts.hpp"

#include <algorithm>

namespace bem {
namespace {

Mat3 contact_frame(const Vec3& normal) {
  // the coordinate axis farthest from the normal makes the first tangent
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Mat3 frame;
  frame.col(0) = normal;
  frame.col(1) = normal.cross(Vec3::Unit(axis)).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

/// Calls f(contact, body, point, sign) for the sides of contacts that are of bodies.
template <class F>
void for_each_side(const std::vector<ContactPair>& pairs, const F& f) {
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    if (pairs[c].body_a >= 0) f(c, pairs[c].body_a, pairs[c].contact.a, 1.0);
    if (pairs[c].body_b >= 0) f(c, pairs[c].body_b, pairs[c].contact.b, -1.0);
  }
}

}  // namespace

PlacedContacts place_contacts(const std::vector<ContactPair>& pairs, std::vector<Body>& bodies) {
  PlacedContacts out;
  out.pairs = pairs;
  out.ports.assign(bodies.size(), {});
  std::vector<std::vector<int>> nodes(bodies.size());
  for_each_side(pairs, [&](std::size_t, int body, const SurfacePoint& p, double) {
    nodes[body].insert(nodes[body].end(), p.vertices.begin(), p.vertices.begin() + p.count);
  });
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    std::sort(nodes[b].begin(), nodes[b].end());
    nodes[b].erase(std::unique(nodes[b].begin(), nodes[b].end()), nodes[b].end());
    bodies[b].set_contact_nodes(nodes[b]);
  }
  for (const ContactPair& pair : pairs) out.frames.push_back(contact_frame(pair.contact.normal));
  for_each_side(pairs, [&](std::size_t c, int body, const SurfacePoint& p, double sign) {
    Port port;
    port.constraint = static_cast<int>(c);
    port.sign = sign;
    port.count = p.count;
    port.weights = p.weights;
    for (int i = 0; i < p.count; ++i)
      port.slots[i] =
          static_cast<int>(std::lower_bound(nodes[body].begin(), nodes[body].end(), p.vertices[i]) -
                           nodes[body].begin());
    out.ports[body].push_back(port);
  });
  return out;
}

Eigen::VectorXd PlacedContacts::to_frames(const std::vector<Vec3>& vectors) const {
  Eigen::VectorXd local(static_cast<Eigen::Index>(3 * vectors.size()));
  for (std::size_t c = 0; c < vectors.size(); ++c)
    local.segment<3>(static_cast<Eigen::Index>(3 * c)) = frames[c].transpose() * vectors[c];
  return local;
}

Eigen::VectorXd PlacedContacts::displacements(const std::vector<Body>& bodies) const {
  std::vector<Vec3> apart;
  for (const ContactPair& pair : pairs) apart.emplace_back(pair.obstacle_a - pair.obstacle_b);
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const Port& p : ports[b])
      for (int i = 0; i < p.count; ++i)
        apart[p.constraint] += p.sign * p.weights[i] *
                               bodies[b].contact_position(static_cast<std::size_t>(p.slots[i]));
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * pairs.size()));
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    auto out = u.segment<3>(static_cast<Eigen::Index>(3 * c));
    out = frames[c].transpose() * (apart[c] - pairs[c].contact.offset_start);
    out[0] = frames[c].col(0).dot(apart[c]);
  }
  return u;
}

void PlacedContacts::add_forces(const std::vector<Vec3>& forces, const std::vector<Body>& bodies,
                                std::vector<ConstraintForces>& by_body) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Vec3 centre = bodies[b].frame().translation();
    for (const Port& p : ports[b]) {
      const Vec3 force = p.sign * forces[p.constraint];
      for (int i = 0; i < p.count; ++i)
        by_body[b].contact.segment<3>(3 * p.slots[i]) += p.weights[i] * force;
      by_body[b].contact_moment += (pairs[p.constraint].contact.point - centre).cross(force);
    }
  }
}

}  // namespace bem
