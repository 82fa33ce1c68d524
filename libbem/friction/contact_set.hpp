#pragma once

#include "friction/friction_problem.hpp"

namespace bem {

/// Contacts that act on each other, directly or through others, as a problem of their own in units
/// in which |q| = 1 and the mean scale of the blocks is 1. No parameter of a solver then depends on
/// the units of the whole problem.
struct ContactSet {
  std::vector<int> contacts;     ///< indices in the whole problem, ascending
  FrictionProblem problem;       ///< dimensionless
  Eigen::VectorXd scale;         ///< per contact |W_ii| / sqrt(3), 1 where that is zero
  double displacement_unit = 1;  ///< |q| of the set
  double force_unit = 1;         ///< |q| / mean scale
  bool finite = true;            ///< W and q are finite and can be scaled
};

/// The connected sets of a problem, in the order of their first contacts.
std::vector<ContactSet> connected_sets(const FrictionProblem& problem);

}  // namespace bem
