#include "friction/set_solver.hpp"

#include "friction/gauss_seidel.hpp"
#include "friction/interior_point.hpp"
#include "friction/natural_map.hpp"
#include "friction/proximal_newton.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace bem {
namespace {

constexpr int kStageSweeps = 20;    ///< sweeps of one staggered problem at most
constexpr int kCheckInterval = 50;  ///< sweeps between evaluations of the error at most

constexpr int kFirstSweeps = 5;  ///< Gauss-Seidel sweeps before Newton's method
constexpr int kInteriorSteps = 100;
constexpr double kPolishBelow =
    1e-4;  ///< error of an interior point from which Newton may converge

/// Regularisations of Newton's method where it starts: at first, near a solution, and on problems
/// on which everything else failed.
constexpr double kFirstAlpha = 1e-3, kPolishAlpha = 1e-6, kPatientAlpha = 1e-3;

/// Interior point steps until a Newton polish from its iterate converges; returns linear solves.
int interior_point_and_polish(const ContactSet& set, double tolerance, int max_steps,
                              ProximalNewton& newton, BestForces& best) {
  InteriorPoint interior(set, best.forces());
  NewtonLimits polish;
  polish.steps_per_goal = 8;
  polish.failures = 0;
  double polish_below = kPolishBelow;
  int steps = 0;
  while (best.error() > tolerance && steps < max_steps) {
    const bool moving = interior.step();
    ++steps;
    const double error = best.consider(interior.forces());
    if (!moving || !std::isfinite(error)) break;
    if (best.error() > polish_below || best.error() <= tolerance) continue;
    polish.steps = std::min(12, max_steps - steps);
    steps += newton.solve(tolerance, kPolishAlpha, polish, best);
    polish_below = 0.01 * std::min(polish_below, error);
  }
  return steps;
}

double deepest(const ContactSet& set, const Eigen::VectorXd& forces) {
  double depth = 0;
  for (int i = 0; i < set.problem.contacts(); ++i)
    depth = std::max(depth, -displacement(set.problem, i, forces)[0]);
  return depth;
}

/// Whether no forces keep all contacts apart, as those of something rigid between closing walls:
/// then contacts that give way ever less come to a limit of their penetration, which else falls
/// with their softness. `best` takes the forces of the softest ones, which share the penetration
/// out without throwing anything about.
bool is_infeasible(const ContactSet& set, double sufficient, ProximalNewton& newton,
                   BestForces& best, int& steps) {
  constexpr int kMostSteps = 15;
  constexpr double kStays = 0.5;  // of the penetration with ten times the softness
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(3 * set.problem.contacts()), soft;
  double last = 0, now = 0;
  for (double alpha : {1e-1, 1e-2, 1e-3, 1e-4}) {
    if (!newton.solve_compliant(alpha, kMostSteps, forces, steps)) return false;
    if (soft.size() == 0) soft = forces;
    last = std::exchange(now, deepest(set, forces));
  }
  const bool infeasible = now > sufficient && now > kStays * last;
  if (infeasible) best.replace(soft);
  return infeasible;
}

}  // namespace

BestForces::BestForces(const ContactSet& set, const Eigen::VectorXd& start)
    : set_(set),
      forces_(Eigen::VectorXd::Zero(start.size())),
      error_(natural_map_norm(set.problem, set.scale, forces_)) {
  consider(start);
}

double BestForces::consider(const Eigen::VectorXd& forces) {
  candidate_.resize(forces.size());
  for (int i = 0; i < set_.problem.contacts(); ++i)
    candidate_.segment<3>(3 * i) = project_cone(forces.segment<3>(3 * i), set_.problem.mu[i]);
  const double error = natural_map_norm(set_.problem, set_.scale, candidate_);
  if (error < error_) {
    error_ = error;
    forces_.swap(candidate_);
  }
  return error;
}

void BestForces::replace(const Eigen::VectorXd& forces) {
  error_ = std::numeric_limits<double>::infinity();
  consider(forces);
}

SetResult solve_staggered(const ContactSet& set, double tolerance, const FrictionOptions& options,
                          BestForces& best) {
  const StaggeredProjections staggered(set);
  SetResult result;
  Eigen::VectorXd forces = best.forces();
  while (best.error() > tolerance && result.sweeps < options.max_sweeps) {
    result.sweeps += staggered.pass(forces, kStageSweeps);
    if (!std::isfinite(best.consider(forces))) break;
  }
  result.error = best.error();
  return result;
}

SetResult solve_nsgs(const ContactSet& set, double tolerance, const FrictionOptions& options,
                     BestForces& best) {
  const GaussSeidel gauss_seidel(set);
  SetResult result;
  Eigen::VectorXd forces = best.forces();
  while (best.error() > tolerance && result.sweeps < options.max_sweeps) {
    const double estimate = gauss_seidel.sweep(forces);
    ++result.sweeps;
    if (estimate <= 2 * tolerance || result.sweeps % kCheckInterval == 0 ||
        result.sweeps == options.max_sweeps)
      if (!std::isfinite(best.consider(forces))) break;
  }
  result.error = best.error();
  return result;
}

SetResult solve_newton(const ContactSet& set, double tolerance, double sufficient,
                       const FrictionOptions& options, BestForces& best) {
  if (!BlockSystem::fits(set.problem)) return solve_nsgs(set, tolerance, options, best);
  SetResult result;
  FrictionOptions first = options;
  first.max_sweeps = std::min(kFirstSweeps, options.max_sweeps);
  result.sweeps = solve_nsgs(set, tolerance, first, best).sweeps;
  ProximalNewton newton(set);
  NewtonLimits attempt;
  attempt.steps = std::min(60, options.max_newton_steps);
  attempt.steps_per_goal = 12;
  attempt.failures = 3;
  int& steps = result.newton_steps;
  steps = newton.solve(tolerance, kFirstAlpha, attempt, best);
  if (best.error() > sufficient && is_infeasible(set, sufficient, newton, best, steps)) {
    result.infeasible = true;
    result.error = best.error();
    return result;
  }
  if (best.error() > sufficient)
    steps += interior_point_and_polish(
        set, sufficient, std::min(kInteriorSteps, options.max_newton_steps - steps), newton, best);
  NewtonLimits rest;
  rest.steps_per_goal = 16;
  rest.steps = options.max_newton_steps - steps;
  if (best.error() > sufficient) steps += newton.solve(sufficient, kPatientAlpha, rest, best);
  result.error = best.error();
  return result;
}

}  // namespace bem
