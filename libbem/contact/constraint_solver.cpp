#include "contact/constraint_solver.hpp"

#include "base/interruption.hpp"
#include "contact/natural_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <set>

namespace bem {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kGoal = 0.05;   ///< of the contact tolerance: error at which an iteration ends
constexpr double kMostTurn = 3;  ///< that contact forces are tried with in a step [rad]

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

}  // namespace

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
  const Body& b = (*bodies_)[body];
  if (b.model().window == 1 && b.has_inertia()) return std::nullopt;  // nothing depends on it
  return mechanisms_[mechanism_of_[body]].holder(body, start_centres_[body], start_, dt_);
}

void ConstraintSolver::begin_step(double t, double dt) {
  start_ = t;
  dt_ = dt;
  first_ = true;
  solves_left_ = kMostStepSolves;
  sweeps_left_ = kMostStepSweeps;
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
  for (const ContactPair& pair : placed_.pairs) {
    present.insert(pair.contact.key);
    arrivals[mover(pair.contact.key)] += known_forces_.count(pair.contact.key) == 0;
  }
  std::map<ContactKey, Vec3> left;
  for (const auto& [key, force] : known_forces_)
    if (present.count(key) == 0) left.try_emplace(mover(key), Vec3::Zero()).first->second += force;
  std::vector<Vec3> out;
  for (const ContactPair& pair : placed_.pairs) {
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
  placed_ = {contacts, {}, {}};
  forces_ = starting_forces();
  placed_.ports.assign(bodies_->size(), {});
  std::vector<std::vector<int>> nodes(bodies_->size());
  const auto for_each_end = [&](const auto& f) {
    for (std::size_t c = 0; c < placed_.pairs.size(); ++c) {
      if (placed_.pairs[c].body_a >= 0)
        f(c, placed_.pairs[c].body_a, placed_.pairs[c].contact.a, 1.0);
      if (placed_.pairs[c].body_b >= 0)
        f(c, placed_.pairs[c].body_b, placed_.pairs[c].contact.b, -1.0);
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
  for (const ContactPair& pair : placed_.pairs)
    placed_.frames.push_back(contact_frame(pair.contact.normal));
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
    placed_.ports[body].push_back(port);
  });
}

void ConstraintSolver::apply_contact_forces() {
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    Eigen::VectorXd& nodal = (*bodies_)[b].contact_forces();
    Vec3& moment = (*bodies_)[b].contact_moment();
    nodal.setZero();
    moment.setZero();
    const Vec3 centre = (*bodies_)[b].frame().translation();
    for (const Port& p : placed_.ports[b]) {
      const Vec3 force = p.sign * forces_[p.constraint];
      for (int i = 0; i < p.count; ++i) nodal.segment<3>(3 * p.slots[i]) += p.weights[i] * force;
      moment += (placed_.pairs[p.constraint].contact.point - centre).cross(force);
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
  for (const ContactPair& pair : placed_.pairs)
    apart.emplace_back(pair.obstacle_a - pair.obstacle_b);
  for (std::size_t b = 0; b < bodies_->size(); ++b)
    for (const Port& p : placed_.ports[b])
      for (int i = 0; i < p.count; ++i)
        apart[p.constraint] += p.sign * p.weights[i] *
                               (*bodies_)[b].contact_position(static_cast<std::size_t>(p.slots[i]));
  Eigen::VectorXd u(static_cast<Eigen::Index>(3 * placed_.pairs.size()));
  for (std::size_t c = 0; c < placed_.pairs.size(); ++c) {
    const Mat3& frame = placed_.frames[c];
    auto out = u.segment<3>(static_cast<Eigen::Index>(3 * c));
    out = frame.transpose() * (apart[c] - placed_.pairs[c].contact.offset_start);
    out[0] = frame.col(0).dot(apart[c]);
  }
  return u;
}

/// World forces in the frames of their contacts.
Eigen::VectorXd ConstraintSolver::local_forces() const {
  Eigen::VectorXd r(static_cast<Eigen::Index>(3 * forces_.size()));
  for (std::size_t c = 0; c < forces_.size(); ++c)
    r.segment<3>(static_cast<Eigen::Index>(3 * c)) = placed_.frames[c].transpose() * forces_[c];
  return r;
}

/// Contacts are met to their own, coarser tolerance, and the joints with them.
double ConstraintSolver::joint_tolerance(const Mechanism& m) const {
  const double extent = (*bodies_)[m.bodies()[0]].model().geometry.extent;
  return (placed_.pairs.empty() ? 1e-11 : 1e-9) * extent;
}

/// Moves the bodies and looks how far they are from what is asked; without a problem for the units
/// of the contacts, their error is the penetration alone.
ConstraintSolver::State ConstraintSolver::evaluate(const ContactProblem* problem) {
  check_interruption();
  State s;
  s.turn = update();
  for (std::size_t m = 0; m < mechanisms_.size(); ++m) {
    s.gaps.push_back(mechanisms_[m].gaps(start_, dt_));
    if (s.gaps[m].size() == 0) continue;
    const double residual = s.gaps[m].allFinite() ? s.gaps[m].cwiseAbs().maxCoeff() : kUnknown;
    s.joint_residual = std::max(residual, s.joint_residual);
    s.joints_met = s.joints_met && residual <= joint_tolerance(mechanisms_[m]);
  }
  s.u = contact_displacements();
  const Eigen::VectorXd r = local_forces();
  for (Eigen::Index i = 0; 3 * i < s.u.size(); ++i) {
    const double miss =
        problem ? problem->scale()[i] * natural_map(r.segment<3>(3 * i), s.u.segment<3>(3 * i),
                                                    problem->friction().mu[i], problem->scale()[i])
                                            .norm()
                : std::max(0.0, -s.u[3 * i]);
    s.contact_residual = std::isfinite(miss) ? std::max(s.contact_residual, miss) : kUnknown;
  }
  return s;
}

std::vector<Vec3> ConstraintSolver::forces_after(const Direction& direction, double step) const {
  std::vector<Vec3> out = forces_;
  for (std::size_t c = 0; c < forces_.size(); ++c)
    out[c] += step *
              (placed_.frames[c] * direction.contacts.segment<3>(static_cast<Eigen::Index>(3 * c)));
  return out;
}

/// By how much contact forces turn the bodies without joints in the step, at most [rad];
/// linearised.
double ConstraintSolver::largest_turn(const std::vector<Vec3>& forces) const {
  double largest = 0;
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    if (placed_.ports[b].empty() || mechanisms_[mechanism_of_[b]].unknowns() > 0) continue;
    const Body::FrameCompliance frame = (*bodies_)[b].contact_frame_compliance();
    Vec3 moment = Vec3::Zero();
    for (const Port& p : placed_.ports[b])
      moment += (placed_.pairs[p.constraint].contact.point - frame.centre)
                    .cross(p.sign * forces[p.constraint]);
    largest = std::max(largest, (frame.rotation * moment).norm());
  }
  return largest;
}

void ConstraintSolver::move(const Direction& direction, double step) {
  forces_ = forces_after(direction, step);
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    if (direction.joints[m].size() > 0) mechanisms_[m].add_forces(step * direction.joints[m]);
}

/// The forces of the last step, some of them on contacts that are gone, may throw a light body far
/// away; then none are a better start.
void ConstraintSolver::choose_start() {
  const std::vector<Vec3> last = forces_;
  const auto largest = [this] {  // of all contacts, whatever their tangents are
    return contact_displacements().reshaped(3, forces_.size()).colwise().norm().maxCoeff();
  };
  double with = kUnknown;
  if (largest_turn(last) <= kMostTurn) {
    update();
    with = largest();
  }
  forces_.assign(forces_.size(), Vec3::Zero());
  update();
  if (with < largest()) forces_ = last;
}

/// One solution of the linear problem about the state, no better than its residual is worth.
ConstraintSolver::Direction ConstraintSolver::find_direction(ContactProblem& problem,
                                                             const State& state, double goal,
                                                             ConstraintStatistics& statistics) {
  constexpr double kInexactness = 0.01, kSufficient = 0.1;
  constexpr double kRounding = 1e-13, kHard = 1e-8;  // of the way without contact forces
  Direction d;
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    d.joints.emplace_back(state.gaps[m].size() == 0
                              ? Eigen::VectorXd()
                              : Eigen::VectorXd(mechanisms_[m].solve(state.gaps[m])));
  const Eigen::VectorXd start = local_forces();
  problem.linearise(state.u, start, d.joints);
  FrictionOptions options;
  options.method = options_.method;
  options.tolerance = kRounding;
  options.sufficient_error = kHard;
  options.absolute_tolerance = std::max(0.1 * goal, kInexactness * state.contact_residual);
  options.sufficient =
      std::max(3 * options.absolute_tolerance, kSufficient * state.contact_residual);
  options.max_newton_steps = std::min(options.max_newton_steps, solves_left_);
  options.max_sweeps = std::min(options.max_sweeps, sweeps_left_);
  Eigen::VectorXd r = start;
  const FrictionResult result = solve_friction(problem.friction(), r, options);
  if (observer_) observer_(problem.friction(), start, result);
  solves_left_ -= result.newton_steps;
  sweeps_left_ -= result.sweeps;
  statistics.infeasible = result.infeasible;
  statistics.sweeps += result.sweeps;
  statistics.newton_steps += result.newton_steps;
  statistics.contact_error = result.error;
  statistics.complementarity = result.complementarity;
  d.contacts = r - start;
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    if (d.joints[m].size() > 0) d.joints[m] += problem.joint_change(m, d.contacts);
  return d;
}

/// Goes along the direction, half the way as long as the residual rises above the reference;
/// leaves the bodies at the best place tried. It starts no farther than where rotations can follow:
/// a body whose motion is not finite cannot come back within the step.
ConstraintSolver::State ConstraintSolver::search(const ContactProblem& problem,
                                                 const Direction& direction, double reference) {
  constexpr int kHalvings = 4;
  constexpr double kShortest = 1e-9;
  const double most = std::max(kMostTurn, largest_turn(forces_));
  double at = 0, step = 1, best_step = 0;
  while (step > kShortest && !(largest_turn(forces_after(direction, step)) <= most)) step *= 0.5;
  State best;
  for (int trial = 0; trial <= kHalvings; ++trial, step *= 0.5) {
    move(direction, step - at);
    at = step;
    State s = evaluate(&problem);
    if (trial == 0 || s.residual() < best.residual()) {
      best = std::move(s);
      best_step = step;
    }
    if (best.residual() <= reference) break;
  }
  if (best_step != at) {
    move(direction, best_step - at);
    best = evaluate(&problem);
  }
  return best;
}

ConstraintStatistics ConstraintSolver::solve_joints() {
  constexpr int kMostIterations = 100, kPatience = 8;
  constexpr double kSlow = 0.5, kStalled = 0.95, kStill = 1e-12;
  ConstraintStatistics statistics;
  double last = kUnknown;
  for (;;) {
    ++statistics.iterations;
    const State s = evaluate(nullptr);
    statistics.joint_residual = s.joint_residual;
    const double residual = s.joint_residual + s.turn;
    statistics.joints_met = s.joints_met && s.turn < kStill;
    if (statistics.joints_met || !std::isfinite(residual) ||
        statistics.iterations >= kMostIterations)
      break;
    if (statistics.iterations > kPatience && residual > kSlow * last) {
      // the bodies may have turned against each other since the matrix was made
      bool refreshed = false;
      for (Mechanism& m : mechanisms_) refreshed = m.refresh() || refreshed;
      if (!refreshed && residual > kStalled * last) {  // rounding ends the progress
        statistics.joints_met = s.joint_residual <= options_.contact_tolerance;
        break;
      }
    }
    last = residual;
    for (std::size_t m = 0; m < mechanisms_.size(); ++m)
      if (s.gaps[m].size() > 0) mechanisms_[m].add_forces(mechanisms_[m].solve(s.gaps[m]));
  }
  return statistics;
}

ConstraintStatistics ConstraintSolver::solve(const std::vector<ContactPair>& contacts,
                                             double goal) {
  constexpr int kMostIterations = 40, kPatience = 6, kPatienceInfeasible = 1, kMemory = 3;
  constexpr double kSlow = 0.1, kVerySlow = 0.5, kProgress = 0.9;
  place_contacts(contacts);
  if (contacts.empty()) return solve_joints();
  if (first_) choose_start();
  first_ = false;
  ConstraintStatistics statistics;
  statistics.contacts = static_cast<int>(contacts.size());
  update();
  std::optional<ContactProblem> problem(std::in_place, placed_, *bodies_, mechanisms_);
  State state = evaluate(&*problem);
  goal = std::max(goal, kGoal * options_.contact_tolerance);
  double best = state.residual(), last = kUnknown;
  Solution best_solution = solution();
  std::deque<double> recent;
  for (int idle = 0;; ++idle) {
    ++statistics.iterations;
    if (state.joints_met && state.contact_residual <= goal) break;
    if (statistics.iterations > kMostIterations || is_exhausted() ||
        idle > (statistics.infeasible ? kPatienceInfeasible : kPatience))
      break;
    const double residual = state.residual();
    if (residual > kSlow * last && statistics.iterations > 2) {
      // the bodies have turned against each other since the matrices were made
      if (residual > kVerySlow * last)
        for (Mechanism& m : mechanisms_) m.refresh();
      problem.emplace(placed_, *bodies_, mechanisms_);
    }
    last = residual;
    recent.push_back(residual);
    if (recent.size() > kMemory) recent.pop_front();
    const Direction direction = find_direction(*problem, state, goal, statistics);
    state = search(*problem, direction, *std::max_element(recent.begin(), recent.end()));
    if (state.residual() < kProgress * best) idle = -1;
    if (state.residual() < best) {
      best = state.residual();
      best_solution = solution();
    }
  }
  // where nothing can be met, forces that share the penetration out are as good as none
  constexpr double kAsGood = 1.1;
  if (state.residual() > (statistics.infeasible ? kAsGood : 1) * best) {
    restore(best_solution);
    state = evaluate(&*problem);
  }
  statistics.exhausted = is_exhausted();
  statistics.joint_residual = state.joint_residual;
  statistics.joints_met = state.joints_met || state.joint_residual <= options_.contact_tolerance;
  statistics.contact_residual = state.contact_residual;
  statistics.contacts_met = state.contact_residual <= options_.contact_tolerance;
  for (Eigen::Index c = 0; c < state.u.size(); c += 3)
    statistics.penetration = std::max(statistics.penetration, -state.u[c]);
  known_forces_.clear();
  for (std::size_t c = 0; c < forces_.size(); ++c)
    known_forces_[placed_.pairs[c].contact.key] = forces_[c];
  return statistics;
}

ConstraintSolver::Solution ConstraintSolver::solution() const {
  Solution s{placed_.pairs, forces_, {}};
  for (const Mechanism& m : mechanisms_) s.joint_forces.push_back(m.forces());
  return s;
}

void ConstraintSolver::restore(const Solution& solution) {
  place_contacts(solution.contacts);
  forces_ = solution.forces;
  known_forces_.clear();
  for (std::size_t c = 0; c < forces_.size(); ++c)
    known_forces_[placed_.pairs[c].contact.key] = forces_[c];
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    mechanisms_[m].set_forces(solution.joint_forces[m]);
  update();
}

void ConstraintSolver::add_impulses(Impulses& sum) const {
  for (const Mechanism& m : mechanisms_) sum.joints += m.impulse_from_world();
  for (std::size_t c = 0; c < placed_.pairs.size(); ++c) {
    if (placed_.pairs[c].body_b < 0) sum.obstacles += dt_ * forces_[c];
    if (placed_.pairs[c].body_a < 0) sum.obstacles -= dt_ * forces_[c];
  }
}

}  // namespace bem
