#include "friction/friction_solver.hpp"

#include "base/error.hpp"
#include "friction/natural_map.hpp"
#include "friction/set_solver.hpp"

#include <algorithm>

namespace bem {
namespace {

SetResult solve_set(const ContactSet& set, const FrictionOptions& options, BestForces& best) {
  const double tolerance =
      std::max(options.tolerance, options.absolute_tolerance / set.displacement_unit);
  switch (options.method) {
    case FrictionMethod::staggered:
      return solve_staggered(set, tolerance, options, best);
    case FrictionMethod::nsgs:
      return solve_nsgs(set, tolerance, options, best);
    case FrictionMethod::newton:
      return solve_newton(set, tolerance,
                          std::max({tolerance, options.sufficient / set.displacement_unit,
                                    options.sufficient_error}),
                          options, best);
  }
  return {};
}

/// Start of a set in its own units, inside the friction cones.
Eigen::VectorXd start_of(const ContactSet& set, const Eigen::VectorXd& forces) {
  Eigen::VectorXd start(3 * set.contacts.size());
  for (std::size_t a = 0; a < set.contacts.size(); ++a) {
    const Vec3 r = forces.segment<3>(3 * set.contacts[a]) / set.force_unit;
    start.segment<3>(static_cast<Eigen::Index>(3 * a)) =
        r.allFinite() ? project_cone(r, set.problem.mu[static_cast<Eigen::Index>(a)])
                      : Vec3(Vec3::Zero());
  }
  return start;
}

/// Measures of the forces of the whole problem.
void measure(const FrictionProblem& problem, const Eigen::VectorXd& forces,
             FrictionResult& result) {
  double product = 0, largest = 0;
  for (int i = 0; i < problem.contacts(); ++i) {
    const double u = displacement(problem, i, forces)[0];
    product = std::max(product, std::abs(u * forces[3 * i]));
    largest = std::max(largest, forces[3 * i]);
    result.penetration = std::max(result.penetration, -u);
  }
  const double unit = largest * problem.q.lpNorm<Eigen::Infinity>();
  result.complementarity = unit > 0 ? product / unit : 0;
}

}  // namespace

FrictionResult solve_friction(const FrictionProblem& problem, Eigen::VectorXd& forces,
                              const FrictionOptions& options) {
  check_problem(problem);
  require(forces.size() == problem.q.size(), "a friction problem has 3n forces");
  FrictionResult result;
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(forces.size());
  for (const ContactSet& set : connected_sets(problem)) {
    if (!set.finite) {
      result.converged = false;
      result.error = result.residual = std::numeric_limits<double>::infinity();
      continue;
    }
    BestForces best(set, start_of(set, forces));
    const SetResult done = solve_set(set, options, best);
    result.sweeps = std::max(result.sweeps, done.sweeps);
    result.newton_steps = std::max(result.newton_steps, done.newton_steps);
    result.infeasible = result.infeasible || done.infeasible;
    result.error = std::max(result.error, done.error);
    result.residual = std::max(result.residual, done.error * set.displacement_unit);
    result.converged = result.converged &&
                       done.error <= std::max(options.tolerance,
                                              options.absolute_tolerance / set.displacement_unit);
    for (std::size_t a = 0; a < set.contacts.size(); ++a)
      solution.segment<3>(3 * set.contacts[a]) =
          set.force_unit * best.forces().segment<3>(static_cast<Eigen::Index>(3 * a));
  }
  forces = solution;
  measure(problem, forces, result);
  return result;
}

double unscaled_friction_error(const FrictionProblem& problem, const Eigen::VectorXd& forces) {
  const double unit = problem.q.norm();
  const double error = natural_map_norm(problem, Eigen::VectorXd::Ones(problem.contacts()), forces);
  return unit > 0 ? error / unit : error;
}

}  // namespace bem
