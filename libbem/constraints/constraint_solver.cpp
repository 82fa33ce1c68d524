#include "constraints/constraint_solver.hpp"

#include "base/interruption.hpp"
#include "dynamics/body_compliance.hpp"
#include "friction/natural_map.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

namespace bem {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

}  // namespace

ConstraintStatistics ConstraintStatistics::with_work_of(const ConstraintStatistics& other) const {
  ConstraintStatistics out = *this;
  out.iterations = other.iterations;
  out.sweeps = other.sweeps;
  out.newton_steps = other.newton_steps;
  return out;
}

ConstraintSolver::ConstraintSolver(const JointPlan& plan, std::vector<Body>& bodies,
                                   const ContactTolerances& tolerances, FrictionMethod method)
    : bodies_(&bodies),
      tolerances_(tolerances),
      method_(method),
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
  solves_left_ = tolerances_.iteration.most_solves;
  sweeps_left_ = tolerances_.iteration.most_sweeps;
  for (Mechanism& m : mechanisms_) m.activate(t + dt);
}

/// Moves all bodies under the current forces; returns the largest change of a rotation.
double ConstraintSolver::update() {
  std::vector<ConstraintForces> by_body;
  for (const Body& body : *bodies_) by_body.push_back(body.no_forces());
  for (const Mechanism& m : mechanisms_) m.add_forces_to(by_body);
  placed_.add_forces(forces_, *bodies_, by_body);
  double turn = 0;
  for (std::size_t b = 0; b < bodies_->size(); ++b)
    turn = std::max(turn, (*bodies_)[b].update(std::move(by_body[b])));
  return turn;
}

double ConstraintSolver::joint_tolerance(const Mechanism& m) const {
  const double extent = (*bodies_)[m.bodies()[0]].model().geometry.extent;
  return (placed_.pairs.empty() ? tolerances_.joints.met : tolerances_.joints.met_with_contacts) *
         extent;
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
  s.u = placed_.displacements(*bodies_);
  const Eigen::VectorXd r = placed_.to_frames(forces_);
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
    out[c] += step * placed_.to_world(direction.contacts, c);
  return out;
}

/// By how much contact forces turn the bodies without joints in the step, at most [rad];
/// linearised.
double ConstraintSolver::largest_turn(const std::vector<Vec3>& forces) const {
  double largest = 0;
  for (std::size_t b = 0; b < bodies_->size(); ++b) {
    if (placed_.ports[b].empty() || mechanisms_[mechanism_of_[b]].unknowns() > 0) continue;
    const BodyCompliance::Frame frame = BodyCompliance((*bodies_)[b]).contact_frame();
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
    return placed_.displacements(*bodies_).reshaped(3, forces_.size()).colwise().norm().maxCoeff();
  };
  double with = kUnknown;
  if (largest_turn(last) <= tolerances_.iteration.most_turn) {
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
  const ContactTolerances::Iteration& t = tolerances_.iteration;
  Direction d;
  for (std::size_t m = 0; m < mechanisms_.size(); ++m)
    d.joints.emplace_back(state.gaps[m].size() == 0
                              ? Eigen::VectorXd()
                              : Eigen::VectorXd(mechanisms_[m].solve(state.gaps[m])));
  const Eigen::VectorXd start = placed_.to_frames(forces_);
  problem.linearise(state.u, start, d.joints);
  FrictionOptions options;
  options.method = method_;
  options.tolerance = t.relative;
  options.sufficient_error = t.relative_sufficient;
  options.absolute_tolerance =
      std::max(t.share_of_goal * goal, t.inexactness * state.contact_residual);
  options.sufficient = std::max(t.sufficient_times * options.absolute_tolerance,
                                t.sufficient * state.contact_residual);
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
  const ContactTolerances::Iteration& t = tolerances_.iteration;
  const double most = std::max(t.most_turn, largest_turn(forces_));
  double at = 0, step = 1, best_step = 0;
  while (step > t.shortest_step && !(largest_turn(forces_after(direction, step)) <= most))
    step *= 0.5;
  State best;
  for (int trial = 0; trial <= t.most_halvings; ++trial, step *= 0.5) {
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
  const ContactTolerances::JointIteration& t = tolerances_.joints;
  ConstraintStatistics statistics;
  double last = kUnknown;
  for (;;) {
    ++statistics.iterations;
    const State s = evaluate(nullptr);
    statistics.joint_residual = s.joint_residual;
    const double residual = s.joint_residual + s.turn;
    statistics.joints_met = s.joints_met && s.turn < t.still;
    if (statistics.joints_met || !std::isfinite(residual) || statistics.iterations >= t.most_steps)
      break;
    if (statistics.iterations > t.patience && residual > t.slow * last) {
      // the bodies may have turned against each other since the matrix was made
      bool refreshed = false;
      for (Mechanism& m : mechanisms_) refreshed = m.refresh() || refreshed;
      if (!refreshed && residual > t.stalled * last) {  // rounding ends the progress
        statistics.joints_met = s.joint_residual <= tolerances_.tolerance;
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
  const ContactTolerances::Iteration& t = tolerances_.iteration;
  placed_ = place_contacts(contacts, *bodies_);
  forces_ = known_forces_.start_for(contacts);
  if (contacts.empty()) return solve_joints();
  if (first_) choose_start();
  first_ = false;
  ConstraintStatistics statistics;
  statistics.contacts = static_cast<int>(contacts.size());
  update();
  std::optional<ContactProblem> problem(std::in_place, placed_, *bodies_, mechanisms_);
  State state = evaluate(&*problem);
  goal = std::max(goal, t.goal);
  double best = state.residual(), last = kUnknown;
  Solution best_solution = solution();
  std::deque<double> recent;
  for (int idle = 0;; ++idle) {
    ++statistics.iterations;
    if (state.joints_met && state.contact_residual <= goal) break;
    if (statistics.iterations > t.most_steps || is_exhausted() ||
        idle > (statistics.infeasible ? t.patience_infeasible : t.patience))
      break;
    const double residual = state.residual();
    if (residual > t.slow * last && statistics.iterations > 2) {
      // the bodies have turned against each other since the matrices were made
      if (residual > t.very_slow * last)
        for (Mechanism& m : mechanisms_) m.refresh();
      problem.emplace(placed_, *bodies_, mechanisms_);
    }
    last = residual;
    recent.push_back(residual);
    if (recent.size() > t.memory) recent.pop_front();
    const Direction direction = find_direction(*problem, state, goal, statistics);
    state = search(*problem, direction, *std::max_element(recent.begin(), recent.end()));
    if (state.residual() < t.progress * best) idle = -1;
    if (state.residual() < best) {
      best = state.residual();
      best_solution = solution();
    }
  }
  if (state.residual() > (statistics.infeasible ? t.as_good : 1) * best) {
    restore(best_solution);
    state = evaluate(&*problem);
  }
  statistics.exhausted = is_exhausted();
  statistics.joint_residual = state.joint_residual;
  statistics.joints_met = state.joints_met || state.joint_residual <= tolerances_.tolerance;
  statistics.contact_residual = state.contact_residual;
  statistics.contacts_met = state.contact_residual <= tolerances_.tolerance;
  for (Eigen::Index c = 0; c < state.u.size(); c += 3)
    statistics.penetration = std::max(statistics.penetration, -state.u[c]);
  known_forces_.set(placed_.pairs, forces_);
  return statistics;
}

ConstraintSolver::Solution ConstraintSolver::solution() const {
  Solution s{placed_.pairs, forces_, {}};
  for (const Mechanism& m : mechanisms_) s.joint_forces.push_back(m.forces());
  return s;
}

void ConstraintSolver::restore(const Solution& solution) {
  placed_ = place_contacts(solution.contacts, *bodies_);
  forces_ = solution.forces;
  known_forces_.set(placed_.pairs, forces_);
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
