#pragma once

#include "contact/friction_problem.hpp"

namespace bem {

enum class FrictionMethod {
  staggered,  ///< projected Gauss-Seidel with staggered projections [Kaufman et al. 2008]
  nsgs,       ///< nonsmooth Gauss-Seidel with exact solves of one contact at a time
  newton,     ///< a few nsgs sweeps, then semismooth Newton, with an interior point fallback
};

/// The error of forces r is the natural map of the problem, with the scale w_i of every contact's
/// own block (root mean square of its singular values):
///
///     e_i = w_i |r_i - P_K(r_i - (u_i + mu |u_t| n) / w_i)|,   error = |e| / |q|,
///
/// per set of contacts that act on each other, and the largest of these. It does not change with
/// the units of W and q.
struct FrictionOptions {
  FrictionMethod method = FrictionMethod::newton;
  double tolerance = 1e-8;        ///< of the error
  double absolute_tolerance = 0;  ///< of |e| in the unit of q [m]: a set at or below it is solved
  /// |e| [m] and error of a set that are not worth the fallbacks of `newton` once its fast stages
  /// have failed.
  double sufficient = 0, sufficient_error = 0;
  int max_sweeps = 2000;        ///< Gauss-Seidel sweeps (staggered, nsgs)
  int max_newton_steps = 1000;  ///< linear solves (newton)
};

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
