#include "friction/proximal_newton.hpp"
#include "support/friction_problems.hpp"
#include "support/uniform.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// Linear solves of Newton's method alone from `start` (dimensionless), almost unregularised.
int newton_steps(const ContactSet& set, const Eigen::VectorXd& start, double tolerance,
                 Eigen::VectorXd& solution) {
  BestForces best(set, start);
  const int steps = ProximalNewton(set).solve(tolerance, 1e-9, NewtonLimits(), best);
  CHECK(best.error() <= tolerance);
  solution = best.forces();
  return steps;
}

}  // namespace

TEST_CASE("Newton's method converges quadratically near a solution") {
  const std::vector<ContactSet> sets = connected_sets(test::halfspace_problem(7, 0.1, 0.6, 0.3));
  REQUIRE(sets.size() == 1);
  Eigen::VectorXd solution, again;
  newton_steps(sets[0], Eigen::VectorXd::Zero(sets[0].problem.q.size()), 1e-13, solution);

  test::Uniform uniform(8);
  Eigen::VectorXd start = solution;
  for (double& value : start) value *= 1 + 1e-4 * uniform();
  CHECK(newton_steps(sets[0], start, 1e-12, again) <= 2);
  CHECK((again - solution).norm() < 1e-10 * solution.norm());

  // contacts that have to open: their forces are released within the same solve
  start = solution;
  int released = 0;
  for (int i = 0; i < sets[0].problem.contacts(); ++i)
    if (solution[3 * i] == 0 && start.segment<3>(3 * i).isZero(0)) {
      start[3 * i] = 1e-4;
      ++released;
    }
  REQUIRE(released > 3);
  CHECK(newton_steps(sets[0], start, 1e-12, again) <= 2);
}

TEST_CASE("Newton's method keeps to its limits") {
  const std::vector<ContactSet> sets = connected_sets(test::stack_problem(10, 3, 0.3, 0.6));
  BestForces best(sets[0], Eigen::VectorXd::Zero(sets[0].problem.q.size()));
  const double before = best.error();
  NewtonLimits limits;
  limits.steps = 7;
  CHECK(ProximalNewton(sets[0]).solve(1e-14, 1e-5, limits, best) <= 7);
  CHECK(best.error() <= before);
}
