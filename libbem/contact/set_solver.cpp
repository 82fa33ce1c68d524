#include "contact/set_solver.hpp"

#include "contact/gauss_seidel.hpp"
#include "contact/natural_map.hpp"

#include <limits>

namespace bem {
namespace {

constexpr int kStageSweeps = 20;    ///< sweeps of one staggered problem at most
constexpr int kCheckInterval = 50;  ///< sweeps between evaluations of the error at most

}  // namespace

BestForces::BestForces(const ContactSet& set, const Eigen::VectorXd& start)
    : set_(set),
      forces_(Eigen::VectorXd::Zero(start.size())),
      error_(natural_map_norm(set.problem, set.scale, forces_)) {
  consider(start);
}

double BestForces::consider(const Eigen::VectorXd& forces) {
  const double error = natural_map_norm(set_.problem, set_.scale, forces);
  if (error < error_) {
    error_ = error;
    forces_ = forces;
  }
  return error;
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

}  // namespace bem
