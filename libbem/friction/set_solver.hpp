#pragma once

#include "friction/contact_set.hpp"
#include "friction/friction_solver.hpp"

namespace bem {

/// What a solver did with one connected set.
struct SetResult {
  int sweeps = 0, newton_steps = 0;
  double error = 0;         ///< of the returned forces
  bool infeasible = false;  ///< no forces keep all contacts apart
};

/// Keeps the forces with the least error, inside the friction cones.
class BestForces {
 public:
  BestForces(const ContactSet& set, const Eigen::VectorXd& start);

  /// Projects `forces` onto the friction cones, evaluates the error there and keeps them if it is
  /// the least so far; returns it.
  double consider(const Eigen::VectorXd& forces);
  /// Takes the forces whatever their error.
  void replace(const Eigen::VectorXd& forces);
  double error() const { return error_; }
  const Eigen::VectorXd& forces() const { return forces_; }

 private:
  const ContactSet& set_;
  Eigen::VectorXd forces_, candidate_;
  double error_;
};

/// Solvers of one set: they improve `best` until its error is at most `tolerance`; the fallbacks of
/// solve_newton() until it is at most `sufficient`.
SetResult solve_staggered(const ContactSet& set, double tolerance, const FrictionOptions& options,
                          BestForces& best);
SetResult solve_nsgs(const ContactSet& set, double tolerance, const FrictionOptions& options,
                     BestForces& best);
SetResult solve_newton(const ContactSet& set, double tolerance, double sufficient,
                       const FrictionOptions& options, BestForces& best);

}  // namespace bem
