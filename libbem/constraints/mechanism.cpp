#include "constraints/mechanism.hpp"

#include "base/error.hpp"
#include "dynamics/body_compliance.hpp"

#include <algorithm>
#include <map>
#include <numeric>

namespace bem {

Mechanism::Mechanism(std::vector<int> bodies, std::vector<int> joints, const JointPlan& plan,
                     std::vector<Body>& all_bodies)
    : plan_(&plan),
      all_bodies_(&all_bodies),
      bodies_(std::move(bodies)),
      joints_(std::move(joints)),
      stages_(all_bodies[bodies_[0]].stages()) {
  forces_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * joints_.size()), stages_);
}

void Mechanism::activate(double t) {
  fresh_ = false;
  std::vector<int> active;
  held_ = false;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = plan_->joints[joints_[j]];
    if (joint.is_active(t)) {
      active.push_back(static_cast<int>(j));
      held_ = held_ || joint.to_world();
    } else {
      forces_.middleRows<3>(static_cast<Eigen::Index>(3 * j)).setZero();
    }
  }
  if (active == active_) return;
  active_ = std::move(active);
  factors_.reset();
}

std::optional<Holder> Mechanism::holder(int body, const Vec3& centre, double t, double dt) const {
  std::vector<const Joint*> prescribed;
  for (int j : active_) {
    const Joint& joint = plan_->joints[joints_[j]];
    if (joint.prescribed && joint.a.body == body) prescribed.push_back(&joint);
  }
  return holder_motion(prescribed, centre, t, dt, (*all_bodies_)[body].stage_times());
}

/// Rotation that the forces of a joint are given in.
const Mat3& Mechanism::axes(const Joint& joint) const {
  return (*all_bodies_)[joint.a.body].rotation(stages_ - 1);
}

int Mechanism::slot(int body, int node) const {
  const auto& nodes = (*all_bodies_)[body].joint_nodes();
  const auto it = std::lower_bound(nodes.begin(), nodes.end(), node,
                                   [](const JointNode& n, int value) { return n.node < value; });
  return static_cast<int>(it - nodes.begin());
}

Vec3 Mechanism::place(const Attachment& at, int stage) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < at.count; ++i)
    sum += at.weights[i] * (*all_bodies_)[at.body].joint_position(
                               static_cast<std::size_t>(slot(at.body, at.nodes[i])), stage);
  return sum;
}

Eigen::VectorXd Mechanism::gaps(double t, double dt) const {
  Eigen::VectorXd out(unknowns());
  const auto block = static_cast<Eigen::Index>(3 * active_.size());
  for (std::size_t j = 0; j < active_.size(); ++j) {
    const Joint& joint = plan_->joints[joints_[active_[j]]];
    const Body& body = (*all_bodies_)[joint.a.body];
    for (int a = 0; a < stages_; ++a) {
      const Vec3 from = place(joint.a, a);
      const Vec3 to =
          joint.to_world() ? joint.target(t + dt * body.stage_times()[a]) : place(joint.b, a);
      out.segment<3>(a * block + static_cast<Eigen::Index>(3 * j)) =
          body.rotation(a).transpose() * (to - from) - joint.offset;
    }
  }
  return out;
}

std::vector<Port> Mechanism::joint_ports(int body) const {
  std::vector<Port> ports;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    const Joint& joint = plan_->joints[joints_[active_[j]]];
    for (const Attachment* end : {&joint.a, &joint.b}) {
      if (end->body != body) continue;
      Port p;
      p.constraint = static_cast<int>(j);
      p.sign = end == &joint.a ? 1 : -1;
      p.count = end->count;
      p.weights = end->weights;
      for (int i = 0; i < end->count; ++i) p.slots[i] = slot(body, end->nodes[i]);
      if (end == &joint.b)
        p.axes = axes(joint).transpose() * (*all_bodies_)[body].rotation(stages_ - 1);
      ports.push_back(p);
    }
  }
  return ports;
}

/// Makes the groups of the active joints and the room for their factors.
void Mechanism::arrange() {
  std::map<std::pair<int, int>, std::vector<int>> by_bodies;
  for (std::size_t j = 0; j < active_.size(); ++j) {
    const Joint& joint = plan_->joints[joints_[active_[j]]];
    by_bodies[std::minmax(joint.a.body, joint.b.body)].push_back(static_cast<int>(j));
  }
  groups_.clear();
  rows_.resize(static_cast<std::size_t>(unknowns()));
  std::vector<int> sizes;
  std::vector<std::vector<int>> coupled(by_bodies.size());
  int row = 0;
  for (const auto& [bodies, joints] : by_bodies) {
    int group = 0;
    for (const auto& [others, unused] : by_bodies) {
      for (int body : {bodies.first, bodies.second})
        if (body >= 0 && (body == others.first || body == others.second))
          coupled[groups_.size()].push_back(group);
      ++group;
    }
    for (int a = 0; a < stages_; ++a)
      for (int j : joints)
        for (int k = 0; k < 3; ++k) rows_[3 * (a * active_.size() + j) + k] = row++;
    sizes.push_back(static_cast<int>(3 * joints.size()) * stages_);
    groups_.push_back(joints);
  }
  factors_ = std::make_unique<BlockLu>(std::move(sizes), coupled);
}

/// By group: where its joints act on a body; constraints are places in the group.
std::vector<std::vector<Port>> Mechanism::ports_by_group(int body) const {
  std::vector<std::pair<int, int>> places(active_.size());  // group and place in it
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t i = 0; i < groups_[g].size(); ++i)
      places[groups_[g][i]] = {static_cast<int>(g), static_cast<int>(i)};
  std::vector<std::vector<Port>> out(groups_.size());
  for (Port port : joint_ports(body)) {
    const auto [group, place] = places[port.constraint];
    port.constraint = place;
    out[group].push_back(port);
  }
  return out;
}

void Mechanism::factorise() {
  arrange();
  const auto block = [&](std::size_t group) {
    return static_cast<Eigen::Index>(3 * groups_[group].size());
  };
  for (int body : bodies_) {
    const std::vector<std::vector<Port>> ports = ports_by_group(body);
    const BodyCompliance compliance((*all_bodies_)[body]);
    if (std::all_of(ports.begin(), ports.end(), [](const auto& p) { return p.empty(); })) continue;
    for (int a = 0; a < stages_; ++a)
      for (int b = 0; b < stages_; ++b) {
        const Eigen::MatrixXd w = compliance.between(NodeGroup::joint, a, NodeGroup::joint, b);
        for (std::size_t g = 0; g < ports.size(); ++g)
          for (std::size_t h = 0; h < ports.size(); ++h)
            if (!ports[g].empty() && !ports[h].empty())
              add_port_compliance(ports[g], ports[h], w,
                                  factors_->block(static_cast<int>(g), static_cast<int>(h))
                                      .block(a * block(g), b * block(h), block(g), block(h)));
      }
  }
  if (!factors_->factorise())
    throw Error(ErrorCode::numerical, "the joints of the body \"" +
                                          (*all_bodies_)[bodies_[0]].name() +
                                          "\" contradict or repeat each other: the matrix of their "
                                          "forces is singular");
  fresh_ = true;
}

bool Mechanism::refresh() {
  if (fresh_ || active_.empty()) return false;
  factorise();
  return true;
}

Eigen::MatrixXd Mechanism::solve(const Eigen::MatrixXd& displacements) {
  if (!factors_) factorise();
  Eigen::MatrixXd grouped(displacements.rows(), displacements.cols()), out = displacements;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    grouped.row(rows_[i]) = displacements.row(static_cast<Eigen::Index>(i));
  factors_->solve(grouped);
  for (std::size_t i = 0; i < rows_.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = grouped.row(rows_[i]);
  return out;
}

void Mechanism::add_forces(const Eigen::VectorXd& change) {
  const Eigen::Index block = unknowns() / stages_;
  for (int a = 0; a < stages_; ++a)
    for (std::size_t j = 0; j < active_.size(); ++j)
      forces_.col(a).segment<3>(3 * active_[j]) +=
          change.segment<3>(a * block + static_cast<Eigen::Index>(3 * j));
}

void Mechanism::visit_state(StateArchive& state) {
  bool factorised = factors_ != nullptr;
  state.resizable(active_);
  state(forces_, factorised);
  for (std::size_t j = 0; j < active_.size(); ++j)
    state.check(active_[j] > (j > 0 ? active_[j - 1] : -1) &&
                active_[j] < static_cast<int>(joints_.size()));
  if (state.restores()) {
    factors_.reset();
    if (factorised) arrange();
  }
  if (factorised) state(*factors_);
}

void Mechanism::add_forces_to(std::vector<ConstraintForces>& by_body) const {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Joint& joint = plan_->joints[joints_[j]];
    for (int a = 0; a < stages_; ++a) {
      const Vec3 force = forces_.col(a).segment<3>(static_cast<Eigen::Index>(3 * j));
      const Mat3& from = (*all_bodies_)[joint.a.body].rotation(a);
      for (const Attachment* end : {&joint.a, &joint.b}) {
        if (end->body < 0) continue;
        const Body& body = (*all_bodies_)[end->body];
        const Vec3 local =
            end == &joint.a ? force : Vec3(-(body.rotation(a).transpose() * (from * force)));
        for (int i = 0; i < end->count; ++i)
          by_body[end->body].joint.col(a).segment<3>(3 * slot(end->body, end->nodes[i])) +=
              end->weights[i] * local;
      }
    }
  }
}

Vec3 Mechanism::impulse_from_world() const {
  Vec3 sum = Vec3::Zero();
  for (int j : active_) {
    const Joint& joint = plan_->joints[joints_[j]];
    if (!joint.to_world()) continue;
    const Body& body = (*all_bodies_)[joint.a.body];
    if (!body.has_inertia()) continue;
    std::vector<Vec3> forces;
    for (int a = 0; a < stages_; ++a)
      forces.emplace_back(body.step().force_rotation[a] *
                          forces_.col(a).segment<3>(static_cast<Eigen::Index>(3 * j)));
    sum += body.frame().impulse_of(forces);
  }
  return sum;
}

void Mechanism::add_coupling(int body, const std::vector<Port>& contacts,
                             Eigen::MatrixXd& joints_by_contacts,
                             Eigen::MatrixXd& contacts_by_joints) const {
  const std::vector<Port> joints = joint_ports(body);
  if (joints.empty() || contacts.empty()) return;
  const BodyCompliance compliance((*all_bodies_)[body]);
  const Eigen::Index block = unknowns() / stages_;
  for (int a = 0; a < stages_; ++a) {
    add_port_compliance(joints, contacts,
                        compliance.between(NodeGroup::joint, a, NodeGroup::contact, 0),
                        joints_by_contacts.middleRows(a * block, block));
    add_port_compliance(contacts, joints,
                        compliance.between(NodeGroup::contact, stages_ - 1, NodeGroup::joint, a),
                        contacts_by_joints.middleCols(a * block, block));
  }
}

std::vector<Mechanism> make_mechanisms(const JointPlan& plan, std::vector<Body>& bodies) {
  std::vector<int> group(bodies.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int b) {
    while (group[b] != b) b = group[b] = group[group[b]];
    return b;
  };
  for (const Joint& joint : plan.joints)
    if (!joint.to_world()) {
      const int a = root(joint.a.body), b = root(joint.b.body);
      group[std::max(a, b)] = std::min(a, b);
    }
  std::vector<std::vector<int>> members(bodies.size()), joints(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    members[root(static_cast<int>(b))].push_back(static_cast<int>(b));
  for (std::size_t j = 0; j < plan.joints.size(); ++j)
    joints[root(plan.joints[j].a.body)].push_back(static_cast<int>(j));
  std::vector<Mechanism> out;
  for (std::size_t first = 0; first < bodies.size(); ++first)
    if (!members[first].empty())
      out.emplace_back(std::move(members[first]), std::move(joints[first]), plan, bodies);
  return out;
}

}  // namespace bem
