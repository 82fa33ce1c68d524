#include "constraints/contact_problem.hpp"

#include "dynamics/body_compliance.hpp"
#include "friction/natural_map.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

/// What the motion of one body's frame adds: with the levers of the bodies as they are, so that
/// large penetrations and deformations do not spoil the linearisation.
void add_frame_compliance(const Body& body, const std::vector<Port>& ports,
                          const std::vector<Port>& local, const PlacedContacts& contacts,
                          Eigen::MatrixXd& out) {
  const BodyCompliance compliance(body);
  const BodyCompliance::Frame frame = compliance.contact_frame();
  const std::size_t count = ports.size();
  std::vector<Mat3> shifts(count), turns(count), levers(count);
  for (std::size_t p = 0; p < count; ++p) {
    const Mat3& axes = contacts.frames[ports[p].constraint];
    const Vec3 arm = contacts.pairs[ports[p].constraint].contact.point - frame.centre;
    Vec3 lever = Vec3::Zero();
    for (int i = 0; i < ports[p].count; ++i)
      lever += ports[p].weights[i] *
               compliance.contact_lever(static_cast<std::size_t>(ports[p].slots[i]));
    turns[p] = ports[p].sign * frame.rotation * cross_matrix(arm) * axes;
    levers[p] = -ports[p].sign * axes.transpose() * cross_matrix(lever);
    shifts[p] = ports[p].sign * axes;
  }
  for (std::size_t q = 0; q < count; ++q) {
    const Mat3 shift = frame.translation * shifts[q];
    for (std::size_t p = 0; p < count; ++p)
      out.block<3, 3>(3 * local[p].constraint, 3 * local[q].constraint).noalias() +=
          shifts[p].transpose() * shift + levers[p] * turns[q];
  }
}

}  // namespace

ContactProblem::ContactProblem(const PlacedContacts& contacts, const std::vector<Body>& bodies,
                               std::vector<Mechanism>& mechanisms) {
  for (Mechanism& m : mechanisms) parts_.push_back(make_part(contacts, bodies, m));
  assemble(contacts);
}

ContactProblem::Part ContactProblem::make_part(const PlacedContacts& contacts,
                                               const std::vector<Body>& bodies,
                                               Mechanism& mechanism) {
  Part part;
  for (int b : mechanism.bodies())
    for (const Port& port : contacts.ports[b]) part.contacts.push_back(port.constraint);
  std::sort(part.contacts.begin(), part.contacts.end());
  part.contacts.erase(std::unique(part.contacts.begin(), part.contacts.end()), part.contacts.end());
  const auto size = static_cast<Eigen::Index>(3 * part.contacts.size());
  const bool jointed = mechanism.unknowns() > 0;
  part.compliance = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd joints_by_contacts = Eigen::MatrixXd::Zero(mechanism.unknowns(), size);
  part.contacts_by_joints = Eigen::MatrixXd::Zero(size, mechanism.unknowns());
  for (int b : mechanism.bodies()) {
    if (contacts.ports[b].empty()) continue;
    const Body& body = bodies[b];
    const BodyCompliance compliance(body);
    std::vector<Port> ports = contacts.ports[b];
    for (Port& port : ports) {
      port.axes = contacts.frames[port.constraint].transpose() * body.rotation(body.stages() - 1);
      port.constraint = static_cast<int>(
          std::lower_bound(part.contacts.begin(), part.contacts.end(), port.constraint) -
          part.contacts.begin());
    }
    if (jointed) {  // with the same levers as the joints
      add_port_compliance(ports, ports,
                          compliance.between(NodeGroup::contact, 0, NodeGroup::contact, 0),
                          part.compliance);
      mechanism.add_coupling(b, ports, joints_by_contacts, part.contacts_by_joints);
      continue;
    }
    if (!body.is_rigid())
      add_port_compliance(ports, ports, compliance.contact_deformation(), part.compliance);
    add_frame_compliance(body, contacts.ports[b], ports, contacts, part.compliance);
  }
  if (jointed && size > 0) {
    part.joint_change = mechanism.solve(joints_by_contacts);
    part.compliance.noalias() -= part.contacts_by_joints * part.joint_change;
  }
  return part;
}

/// The compliances of all mechanisms as one sparse matrix.
void ContactProblem::assemble(const PlacedContacts& contacts) {
  const auto n = static_cast<int>(contacts.pairs.size());
  std::vector<std::vector<std::pair<int, int>>> places(n);  // (part, position in it) of a contact
  for (std::size_t m = 0; m < parts_.size(); ++m)
    for (std::size_t i = 0; i < parts_[m].contacts.size(); ++i)
      places[parts_[m].contacts[i]].emplace_back(static_cast<int>(m), static_cast<int>(i));
  FrictionProblem& f = friction_;
  f.mu.resize(n);
  f.q = Eigen::VectorXd::Zero(3 * n);
  scale_.resize(n);
  std::vector<int> place(n, -1);  // of a column in the current row
  for (int c = 0; c < n; ++c) {
    f.mu[c] = contacts.pairs[c].friction;
    const auto begin = static_cast<std::size_t>(f.row_start.back());
    for (const auto& [m, i] : places[c])
      f.columns.insert(f.columns.end(), parts_[m].contacts.begin(), parts_[m].contacts.end());
    std::sort(f.columns.begin() + static_cast<std::ptrdiff_t>(begin), f.columns.end());
    f.columns.erase(
        std::unique(f.columns.begin() + static_cast<std::ptrdiff_t>(begin), f.columns.end()),
        f.columns.end());
    f.blocks.resize(f.columns.size(), Mat3::Zero());
    for (std::size_t k = begin; k < f.columns.size(); ++k)
      place[f.columns[k]] = static_cast<int>(k);
    for (const auto& [m, i] : places[c])
      for (std::size_t j = 0; j < parts_[m].contacts.size(); ++j)
        f.blocks[place[parts_[m].contacts[j]]] +=
            parts_[m].compliance.block<3, 3>(3 * i, static_cast<Eigen::Index>(3 * j));
    f.row_start.push_back(static_cast<int>(f.columns.size()));
    scale_[c] = f.blocks[place[c]].norm() / std::sqrt(3.0);
    if (!(scale_[c] > 0)) scale_[c] = 1;
  }
}

void ContactProblem::linearise(const Eigen::VectorXd& u, const Eigen::VectorXd& r,
                               const std::vector<Eigen::VectorXd>& joint_changes) {
  FrictionProblem& f = friction_;
  f.q.setZero();
  Eigen::VectorXd q = u;
  for (int c = 0; c < f.contacts(); ++c) q.segment<3>(3 * c) -= displacement(f, c, r);
  for (std::size_t m = 0; m < parts_.size(); ++m) {
    const Part& part = parts_[m];
    if (joint_changes[m].size() == 0 || part.contacts.empty()) continue;
    const Eigen::VectorXd change = part.contacts_by_joints * joint_changes[m];
    for (std::size_t i = 0; i < part.contacts.size(); ++i)
      q.segment<3>(3 * part.contacts[i]) += change.segment<3>(static_cast<Eigen::Index>(3 * i));
  }
  f.q = std::move(q);
}

Eigen::VectorXd ContactProblem::joint_change(std::size_t mechanism,
                                             const Eigen::VectorXd& force_change) const {
  const Part& part = parts_[mechanism];
  Eigen::VectorXd change(3 * part.contacts.size());
  for (std::size_t i = 0; i < part.contacts.size(); ++i)
    change.segment<3>(static_cast<Eigen::Index>(3 * i)) =
        force_change.segment<3>(3 * part.contacts[i]);
  if (part.contacts.empty()) return Eigen::VectorXd::Zero(part.contacts_by_joints.cols());
  return -part.joint_change * change;
}

}  // namespace bem
