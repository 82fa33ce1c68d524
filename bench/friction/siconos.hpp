#pragma once

#include "friction/friction_problem.hpp"

namespace bem {

enum class SiconosMethod { nsgs, nsn_ac };

/// Solves a problem with Siconos (numerics component), in units in which the own blocks of W and q
/// are of order one. Its error measure is the unscaled natural map there. Returns the iterations.
int solve_with_siconos(const FrictionProblem& problem, SiconosMethod method, double tolerance,
                       int max_iterations, Eigen::VectorXd& forces);

}  // namespace bem
