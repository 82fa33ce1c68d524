#pragma once

#include "friction/friction_options.hpp"
#include "friction/friction_problem.hpp"

namespace bem {

struct FrictionResult {
  int sweeps = 0;              ///< Gauss-Seidel sweeps of the set that needed most
  int newton_steps = 0;        ///< linear solves of the set that needed most
  double error = 0;            ///< as above
  double residual = 0;         ///< largest |e| of a set, in the unit of q [m]
  double complementarity = 0;  ///< max |u_n r_n| / (max |r_n| max |q|)
  double penetration = 0;      ///< max of -u_n and 0, in the unit of q [m]
  bool converged = true;       ///< every set is within one of the tolerances
  bool infeasible = false;     ///< found by `newton`: no forces keep all contacts of a set apart
};

/// Solves the problem. `forces` (3n) holds the starting point (a solution nearby saves work; zero
/// otherwise; values that are not finite count as zero) and receives the best forces found, which
/// are finite and satisfy the cone constraints whether or not they converged.
FrictionResult solve_friction(const FrictionProblem& problem, Eigen::VectorXd& forces,
                              const FrictionOptions& options = {});

/// |natural map of all contacts with w_i = 1| / |q|, the measure of the FCLIB collection. It
/// depends on the units of W.
double unscaled_friction_error(const FrictionProblem& problem, const Eigen::VectorXd& forces);

}  // namespace bem
