#include "contact/constraint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

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

Eigen::VectorXd compliance_times(const FrictionProblem& f, const Eigen::VectorXd& r) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(r.size());
  for (int c = 0; c < f.contacts(); ++c)
    for (int k = f.row_start[c]; k < f.row_start[c + 1]; ++k)
      u.segment<3>(3 * c) += f.blocks[k] * r.segment<3>(3 * f.columns[k]);
  return u;
}

}  // namespace

/// The linearised contact problem of a set of contacts and what it takes to eliminate the joints.
struct ConstraintSolver::Problem {
  struct Part {
    std::vector<int> contacts;           ///< that touch a mechanism, ascending
    Eigen::MatrixXd compliance;          ///< among them, joints eliminated
    Eigen::MatrixXd joint_change;        ///< W_bb^{-1} W_bc
    Eigen::MatrixXd contacts_by_joints;  ///< W_cb
  };
  std::vector<Part> parts;  ///< by mechanism
  FrictionProblem friction;
  bool built = false;
};

ConstraintSolver::ConstraintSolver(const JointPlan& plan, std::vector<Body>& bodies,
                                   const ConstraintOptions& options)
    : bodies_(&bodies),
      options_(options),
      mechanisms_(make_mechanisms(plan, bodies)),
      mechanism_of_(bodies.size(), -1) {
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    for (int b : mechanisms_[m].bodies()) mechanism_of_[b] = static_cast<int>(m);
  for (const Body& body : bodies) start_centres_.push_back(body.frame().translation());
}

std::optional<Holder> ConstraintSolver::holder(int body) const {
  if ((*bodies_)[body].model().window == 1) return std::nullopt;  // nothing depends on it
  return mechanisms_[mechanism_of_[body]].holder(body, start_centres_[body], start_, dt_);
}

void ConstraintSolver::begin_step(double t, double dt) {
  start_ = t;
  dt_ = dt;
  for (Mechanism& m : mechanisms_) m.activate(t + dt);
}

/// What the contact solver starts from: the force of the same contact in the last call. A vertex or
/// edge that has left triangles or edges of a surface for others of it takes their forces along, in
/// equal parts.
std::vector<Vec3> ConstraintSolver::starting_forces() const {
  const auto mover = [](ContactKey key) {
    key.feature_b = -1;
    return key;
  };
  std::set<ContactKey> present;
  std::map<ContactKey, int> arrivals;
  for (const ContactPair& pair : contacts_) {
    present.insert(pair.contact.key);
    arrivals[mover(pair.contact.key)] += known_forces_.count(pair.contact.key) == 0;
  }
  std::map<ContactKey, Vec3> left;
  for (const auto& [key, force] : known_forces_)
    if (present.count(key) == 0) left.try_emplace(mover(key), Vec3::Zero()).first->second += force;
  std::vector<Vec3> out;
  for (const ContactPair& pair : contacts_) {
    const ContactKey& key = pair.contact.key;
    const auto known = known_forces_.find(key);
    const auto moved = left.find(mover(key));
    if (known != known_forces_.end())
      out.push_back(known->second);
    else if (moved != left.end())
      out.emplace_back(moved->second / arrivals[mover(key)]);
    else
      out.emplace_back(Vec3::Zero());
  }
  return out;
}

/// Tells the bodies which of their nodes are in contact, and finds the forces to start from.
void ConstraintSolver::place_contacts(const std::vector<ContactPair>& contacts) {
  contacts_ = contacts;
  frames_.clear();
  // The problem is linearised about the motion without contact forces: those of the last step, some
  // of them on contacts that are gone, may throw a light body far away.
  forces_.assign(contacts_.size(), Vec3::Zero());
  guesses_ = starting_forces();
  ports_.assign(bodies_->size(), {});
  std::vector<std::vector<int>> nodes(bodies_->size());
  const auto for_each_end = [&](const auto& f) {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (contacts_[c].body_a >= 0) f(c, contacts_[c].body_a, contacts_[c].contact.a, 1.0);
      if (contacts_[c].body_b >= 0) f(c, contacts_[c].body_b, contacts_[c].contact.b, -1.0);
    }
  };
  for_each_end([&](std::size_t, int body, const SurfacePoint& p, double) {
    nodes[body].insert(nodes[body].end(), p.vertices.begin(), p.vertices.begin() + p.count);
  });
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    std::sort(nodes[b].begin(), nodes[b].end());
    nodes[b].erase(std::unique(nodes[b].begin(), nodes[b].end()), nodes[b].end());
    (*bodies_)[b].set_contact_nodes(nodes[b]);
  }
  for (const ContactPair& pair : contacts_) frames_.push_back(contact_frame(pair.contact.normal));
  for_each_end([&](std::size_t c, int body, const SurfacePoint& p, double sign) {
    Port port;
    port.constraint = static_cast<int>(c);
    port.sign = sign;
    port.count = p.count;
    port.weights = p.weights;
    for (int i = 0; i < p.count; ++i)
      port.slots[i] =
          static_cast<int>(std::lower_bound(nodes[body].begin(), nodes[body].end(), p.vertices[i]) -
                           nodes[body].begin());
    ports_[body].push_back(port);
  });
}

void ConstraintSolver::apply_contact_forces() {
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    Eigen::VectorXd& nodal = (*bodies_)[b].contact_forces();
    Vec3& moment = (*bodies_)[b].contact_moment();
    nodal.setZero();
    moment.setZero();
    const Vec3 centre = (*bodies_)[b].frame().translation();
    for (const Port& p : ports_[b]) {
      const Vec3 force = p.sign * forces_[p.constraint];
      for (int i = 0; i < p.count; ++i) nodal.segment<3>(3 * p.slots[i]) += p.weights[i] * force;
      moment += (contacts_[p.constraint].contact.point - centre).cross(force);
    }
  }
}

/// Moves all bodies under the current forces; returns the largest change of a rotation.
double ConstraintSolver::update() {
  for (Mechanism& m : mechanisms_) m.apply_forces();
  apply_contact_forces();
  double turn = 0;
  for (Body& body : *bodies_) turn = std::max(turn, body.update());
  return turn;
}

/// Gap and slip of the contacts at the end of the step, in their frames [m].
Eigen::VectorXd ConstraintSolver::contact_displacements() const {
  std::vector<Vec3> apart;
  for (const ContactPair& pair : contacts_) apart.emplace_back(pair.obstacle_a - pair.obstacle_b);
  for (std::size_t b = 0; b < bodies_->size(); ++b)
    for (const Port& p : ports_[b])
      for (int i = 0; i < p.count; ++i)
        apart[p.constraint] += p.sign * p.weights[i] *
                               (*bodies_)[b].contact_position(static_cast<std::size_t>(p.slots[i]));
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * contacts_.size()));
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Mat3& frame = frames_[c];
    auto out = u.segment<3>(static_cast<Eigen::Index>(3 * c));
    out = frame.transpose() * (apart[c] - contacts_[c].contact.offset_start);
    out[0] = frame.col(0).dot(apart[c]);
  }
  return u;
}

std::vector<Eigen::VectorXd> ConstraintSolver::joint_gaps() const {
  std::vector<Eigen::VectorXd> gaps;
  for (const Mechanism& m : mechanisms_) gaps.push_back(m.gaps(start_, dt_));
  return gaps;
}

/// Compliance of the contacts with the joints held, mechanism by mechanism, as one sparse matrix.
void ConstraintSolver::build(Problem& p) {
  const auto n = static_cast<int>(contacts_.size());
  p.parts.clear();
  std::vector<std::vector<std::pair<int, int>>> places(n);  // (part, position in it) of a contact
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    Problem::Part part;
    for (int b : mechanisms_[m].bodies())
      for (const Port& port : ports_[b]) part.contacts.push_back(port.constraint);
    std::sort(part.contacts.begin(), part.contacts.end());
    part.contacts.erase(std::unique(part.contacts.begin(), part.contacts.end()),
                        part.contacts.end());
    const auto size = static_cast<Eigen::Index>(3 * part.contacts.size());
    for (std::size_t i = 0; i < part.contacts.size(); ++i)
      places[part.contacts[i]].emplace_back(static_cast<int>(m), static_cast<int>(i));
    part.compliance = Eigen::MatrixXd::Zero(size, size);
    Eigen::MatrixXd joints_by_contacts = Eigen::MatrixXd::Zero(mechanisms_[m].unknowns(), size);
    part.contacts_by_joints = Eigen::MatrixXd::Zero(size, mechanisms_[m].unknowns());
    for (int b : mechanisms_[m].bodies()) {
      if (ports_[b].empty()) continue;
      const Body& body = (*bodies_)[b];
      std::vector<Port> ports = ports_[b];
      for (Port& port : ports) {
        port.axes = frames_[port.constraint].transpose() * body.rotation(body.stages() - 1);
        port.constraint = static_cast<int>(
            std::lower_bound(part.contacts.begin(), part.contacts.end(), port.constraint) -
            part.contacts.begin());
      }
      add_port_compliance(ports, ports,
                          body.compliance(Body::Group::contact, 0, Body::Group::contact, 0),
                          part.compliance);
      mechanisms_[m].add_coupling(b, ports, joints_by_contacts, part.contacts_by_joints);
    }
    if (mechanisms_[m].unknowns() > 0 && size > 0) {
      part.joint_change = mechanisms_[m].solve(joints_by_contacts);
      part.compliance.noalias() -= part.contacts_by_joints * part.joint_change;
    }
    p.parts.push_back(std::move(part));
  }
  FrictionProblem& f = p.friction;
  f = {};
  f.mu.resize(n);
  for (int c = 0; c < n; ++c) {
    f.mu[c] = contacts_[c].friction;
    std::map<int, Mat3> row;  // coupled contact -> block
    for (const auto& [m, i] : places[c]) {
      const Problem::Part& part = p.parts[m];
      for (std::size_t j = 0; j < part.contacts.size(); ++j)
        row.try_emplace(part.contacts[j], Mat3::Zero()).first->second +=
            part.compliance.block<3, 3>(3 * i, static_cast<Eigen::Index>(3 * j));
    }
    for (const auto& [column, block] : row) {
      f.columns.push_back(column);
      f.blocks.push_back(block);
    }
    f.row_start.push_back(static_cast<int>(f.columns.size()));
  }
  p.built = true;
}

/// One solution of the linearised problem, from displacements u and joints that miss by what
/// `joint_changes` would mend. Changes the forces; returns the displacements that the contacts
/// should have after it.
Eigen::VectorXd ConstraintSolver::solve_contacts(Problem& p,
                                                 const std::vector<Eigen::VectorXd>& joint_changes,
                                                 const Eigen::VectorXd& u,
                                                 ConstraintStatistics& statistics) {
  const auto n = static_cast<int>(contacts_.size());
  Eigen::VectorXd start(3 * n), r(3 * n);
  for (int c = 0; c < n; ++c) {
    start.segment<3>(3 * c) = frames_[c].transpose() * forces_[c];
    r.segment<3>(3 * c) = frames_[c].transpose() * guesses_[c];
  }
  FrictionProblem& f = p.friction;
  f.q = u - compliance_times(f, start);
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    const Problem::Part& part = p.parts[m];
    if (joint_changes[m].size() == 0 || part.contacts.empty()) continue;
    const Eigen::VectorXd change = part.contacts_by_joints * joint_changes[m];
    for (std::size_t i = 0; i < part.contacts.size(); ++i)
      f.q.segment<3>(3 * part.contacts[i]) += change.segment<3>(static_cast<Eigen::Index>(3 * i));
  }
  FrictionOptions options;
  options.method = options_.method;
  options.absolute_tolerance = 0.01 * options_.contact_tolerance;
  options.sufficient = 0.1 * options_.contact_tolerance;
  const Eigen::VectorXd guess = observer_ ? r : Eigen::VectorXd();
  const FrictionResult result = solve_friction(f, r, options);
  if (observer_ && n > 0) observer_(f, guess, result);
  statistics.sweeps += result.sweeps;
  statistics.newton_steps += result.newton_steps;
  statistics.contact_error = result.error;
  statistics.contact_residual = result.residual;
  statistics.complementarity = result.complementarity;
  for (int c = 0; c < n; ++c) guesses_[c] = forces_[c] = frames_[c] * r.segment<3>(3 * c);
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    const Problem::Part& part = p.parts[m];
    if (joint_changes[m].size() == 0) continue;
    Eigen::VectorXd change = joint_changes[m];
    if (!part.contacts.empty()) {
      Eigen::VectorXd force_change(3 * part.contacts.size());
      for (std::size_t i = 0; i < part.contacts.size(); ++i)
        force_change.segment<3>(static_cast<Eigen::Index>(3 * i)) =
            (r - start).segment<3>(3 * part.contacts[i]);
      change -= part.joint_change * force_change;
    }
    mechanisms_[m].add_forces(change);
  }
  return f.q + compliance_times(f, r);
}

/// Contacts are met to their own, coarser tolerance, and the joints with them.
double ConstraintSolver::joint_tolerance(const Mechanism& m) const {
  const double extent = (*bodies_)[m.bodies()[0]].model().geometry.extent;
  return (contacts_.empty() ? 1e-11 : 1e-9) * extent;
}

ConstraintStatistics ConstraintSolver::solve(const std::vector<ContactPair>& contacts) {
  constexpr int kMostIterations = 100, kPatience = 8;
  constexpr double kSlow = 0.5, kStalled = 0.95;
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  place_contacts(contacts);
  ConstraintStatistics statistics;
  statistics.contacts = static_cast<int>(contacts_.size());
  Problem problem;
  bool linearised_again = false;
  double miss = 0, last_residual = kUnknown;
  Eigen::VectorXd expected;  // displacements of the contacts by the linear problem
  for (;;) {
    ++statistics.iterations;
    const double turn = update();
    const std::vector<Eigen::VectorXd> gaps = joint_gaps();
    const Eigen::VectorXd u = contact_displacements();
    statistics.joint_residual = 0;
    bool joints_met = true;
    for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
      if (gaps[m].size() == 0) continue;
      const double residual = gaps[m].allFinite() ? gaps[m].cwiseAbs().maxCoeff() : std::nan("");
      statistics.joint_residual = std::max(residual, statistics.joint_residual);
      joints_met = joints_met && residual <= joint_tolerance(mechanisms_[m]);
    }
    miss = expected.size() > 0 ? (u - expected).cwiseAbs().maxCoeff() : kUnknown;
    const bool contacts_met = miss <= 0.1 * options_.contact_tolerance;
    statistics.penetration = 0;
    for (Eigen::Index c = 0; c < u.size(); c += 3)
      statistics.penetration = std::max(statistics.penetration, -u[c]);
    const bool met = joints_met && (contacts_.empty() ? turn < 1e-12 : contacts_met);
    const double residual = statistics.joint_residual + (contacts_.empty() ? turn : miss);
    if (met || std::isnan(residual) || statistics.iterations >= kMostIterations) {
      statistics.joints_met = joints_met && (!contacts_.empty() || turn < 1e-12);
      break;
    }
    if (statistics.iterations > kPatience && residual > kSlow * last_residual) {
      // the bodies may have turned against each other since the matrix was made
      bool refreshed = !contacts_.empty() && !linearised_again;
      linearised_again = true;
      for (Mechanism& m : mechanisms_) refreshed = m.refresh() || refreshed;
      if (refreshed) {
        problem.built = false;
      } else if (residual > kStalled * last_residual) {  // rounding ends the progress
        statistics.joints_met = statistics.joint_residual <= options_.contact_tolerance;
        break;
      }
    }
    last_residual = residual;
    std::vector<Eigen::VectorXd> changes;
    for (std::size_t m = 0; m < mechanisms_.size(); ++m)
      changes.emplace_back(gaps[m].size() == 0 ? Eigen::VectorXd()
                                               : Eigen::VectorXd(mechanisms_[m].solve(gaps[m])));
    if (!problem.built) build(problem);
    expected = solve_contacts(problem, changes, u, statistics);
  }
  if (contacts_.empty()) return statistics;
  statistics.contact_residual =
      std::isnan(miss) ? kUnknown : std::max(statistics.contact_residual, miss);
  statistics.contacts_met = statistics.contact_residual <= options_.contact_tolerance;
  known_forces_.clear();
  for (std::size_t c = 0; c < contacts_.size(); ++c)
    known_forces_[contacts_[c].contact.key] = forces_[c];
  return statistics;
}

void ConstraintSolver::add_impulses(Impulses& sum) const {
  for (const Mechanism& m : mechanisms_) sum.joints += m.impulse_from_world();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    if (contacts_[c].body_b < 0) sum.obstacles += dt_ * forces_[c];
    if (contacts_[c].body_a < 0) sum.obstacles -= dt_ * forces_[c];
  }
}

}  // namespace bem
