#include "friction/interior_point.hpp"
#include "support/friction_problems.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

/// Steps from no forces to an error of 1e-4, from where Newton's method takes over.
int interior_steps(const FrictionProblem& problem) {
  const std::vector<ContactSet> sets = connected_sets(problem);
  REQUIRE(sets.size() == 1);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.q.size());
  BestForces best(sets[0], zero);
  InteriorPoint interior(sets[0], zero);
  int steps = 0;
  while (best.error() > 1e-4 && steps < 100 && interior.step()) {
    ++steps;
    best.consider(interior.forces());
  }
  return best.error() <= 1e-4 ? steps : 1000;
}

}  // namespace

TEST_CASE("the interior point method solves hyperstatic problems in few steps") {
  CHECK(interior_steps(test::stack_problem(1, 6, 0.4, 0.6)) <= 10);
  CHECK(interior_steps(test::stack_problem(6, 3, 0.5, 0.3)) <= 10);
  CHECK(interior_steps(test::wall_problem(4, 4, 0.7, 0.3)) <= 10);
}

TEST_CASE("the interior point method with no, little and mixed friction") {
  CHECK(interior_steps(test::halfspace_problem(6, 0.1, 0.8, 1)) <= 10);
  CHECK(interior_steps(test::halfspace_problem(6, 0, 0, 1)) <= 10);
  for (double low : {0.0, 1e-3}) {
    FrictionProblem mixed = test::stack_problem(3, 3, 0.5, 0.3);
    for (int i = 0; i < mixed.contacts(); i += 2) mixed.mu[i] = low;
    CHECK(interior_steps(mixed) <= 10);
  }
}
