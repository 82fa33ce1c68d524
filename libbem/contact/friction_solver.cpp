#include "contact/friction_solver.hpp"

namespace bem {

FrictionResult solve_friction(const FrictionProblem&, Eigen::VectorXd&, const FrictionOptions&) {
  return {};
}
double unscaled_friction_error(const FrictionProblem&, const Eigen::VectorXd&) {
  return 0;
}

}  // namespace bem
