#include "friction/friction_solver.hpp"
#include "support/friction_problems.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

struct Solution {
  Eigen::VectorXd forces;
  FrictionResult result;
};

Solution solve(const FrictionProblem& problem, FrictionMethod method = FrictionMethod::newton,
               int max_sweeps = 2000) {
  FrictionOptions options;
  options.method = method;
  options.max_sweeps = max_sweeps;
  Solution solution{Eigen::VectorXd::Zero(problem.q.size()), {}};
  solution.result = solve_friction(problem, solution.forces, options);
  return solution;
}

void check_solved(const FrictionProblem& problem) {
  const Solution s = solve(problem);
  INFO("contacts " << problem.contacts() << ", Newton steps " << s.result.newton_steps);
  CHECK(s.result.converged);
  CHECK(s.result.error <= 1e-8);
  CHECK(s.forces.allFinite());
}

}  // namespace

TEST_CASE("the methods agree where the solution is unique") {
  FrictionProblem problem = test::halfspace_problem(7, 0.1, 0.6, 0.3);
  for (double asymmetry : {0.0, 0.07, 0.3}) {
    if (asymmetry > 0) test::make_unsymmetric(problem, asymmetry);
    const Solution newton = solve(problem), nsgs = solve(problem, FrictionMethod::nsgs),
                   staggered = solve(problem, FrictionMethod::staggered, 20000);
    CHECK(newton.result.converged);
    CHECK(nsgs.result.converged);
    CHECK(staggered.result.converged);
    CHECK((nsgs.forces - newton.forces).norm() < 1e-6 * newton.forces.norm());
    CHECK((staggered.forces - newton.forces).norm() < 1e-6 * newton.forces.norm());
    // all states are there
    int open = 0, stick = 0, slide = 0;
    for (int i = 0; i < problem.contacts(); ++i) {
      const Vec3 r = newton.forces.segment<3>(3 * i);
      const double margin = problem.mu[i] * r[0] - r.tail<2>().norm();
      ++(r[0] < 1e-9 ? open : margin > 1e-6 * r[0] ? stick : slide);
    }
    CHECK(open > 3);
    CHECK(slide > 3);
    CHECK(stick > 0);
  }
}

TEST_CASE("elastic half-spaces: unsymmetric and slightly indefinite compliances") {
  for (int side : {4, 9})
    for (double mu : {0.3, 1.5})
      for (double drag : {0.1, 1.0, 3.0})
        for (double asymmetry : {0.0, 0.07, 0.3}) {
          FrictionProblem problem = test::halfspace_problem(side, 0, mu, drag);
          if (asymmetry > 0) test::make_unsymmetric(problem, asymmetry);
          check_solved(problem);
          test::make_indefinite(problem, 1e-4);
          check_solved(problem);
        }
  check_solved(test::halfspace_problem(18, 0, 1.5, 1));
}

TEST_CASE("stacks, tables and walls of rigid bodies") {
  for (double mu : {0.0, 0.1, 0.5, 1.2})
    for (double push : {0.1, 0.8}) {
      check_solved(test::stack_problem(3, 3, mu, push));
      check_solved(test::stack_problem(10, 2, mu, push));
      check_solved(test::wall_problem(4, 5, mu, push));
    }
  FrictionProblem mixed = test::stack_problem(6, 3, 0.5, 0.3);
  for (int i = 0; i < mixed.contacts(); i += 2) mixed.mu[i] = i % 4 == 0 ? 0 : 1e-3;
  check_solved(mixed);
  check_solved(test::stack_problem(1, 14, 0.3, 0.5));
  check_solved(test::stack_problem(40, 3, 0.5, 0.3));
  check_solved(test::wall_problem(10, 14, 0.6, 0.3));
}

TEST_CASE("random problems of full and of low rank") {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    check_solved(test::random_problem(10, 60, 0, 1, seed));
    check_solved(test::random_problem(50, 100, 0, 1, seed));
    FrictionProblem square = test::random_problem(60, 180, 0, 1.5, seed);
    check_solved(square);
    test::make_unsymmetric(square, 0.3, seed);
    test::make_indefinite(square, 1e-4);
    check_solved(square);
  }
}

TEST_CASE("results are the same when solved again, and sets do not see each other") {
  const FrictionProblem one = test::stack_problem(4, 2, 0.4, 0.5, 1);
  const FrictionProblem two = test::halfspace_problem(4, 0.1, 0.9, 1);
  FrictionProblem both = one;
  for (std::size_t k = 0; k < two.blocks.size(); ++k) {
    both.columns.push_back(two.columns[k] + one.contacts());
    both.blocks.push_back(two.blocks[k]);
  }
  for (int i = 1; i <= two.contacts(); ++i)
    both.row_start.push_back(two.row_start[i] + static_cast<int>(one.blocks.size()));
  both.q.resize(one.q.size() + two.q.size());
  both.q << one.q, two.q;
  both.mu.resize(one.mu.size() + two.mu.size());
  both.mu << one.mu, two.mu;
  for (FrictionMethod method :
       {FrictionMethod::staggered, FrictionMethod::nsgs, FrictionMethod::newton}) {
    const Solution all = solve(both, method), again = solve(both, method);
    CHECK(all.forces == again.forces);
    CHECK(all.forces.head(one.q.size()) == solve(one, method).forces);
    CHECK(all.forces.tail(two.q.size()) == solve(two, method).forces);
  }
}

TEST_CASE("an error that is sufficient saves the fallbacks of newton") {
  const FrictionProblem p = test::stack_problem(40, 3, 0.1, 0.3);
  FrictionOptions options;
  const auto solve = [&] {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(p.q.size());
    return solve_friction(p, r, options);
  };
  const FrictionResult full = solve();
  options.sufficient = 0.01 * p.q.norm();
  const FrictionResult quick = solve();
  CHECK(full.converged);
  CHECK(full.residual <= 1e-8 * p.q.norm());
  CHECK(quick.residual <= options.sufficient);
  CHECK(quick.newton_steps < 0.5 * full.newton_steps);
  options.sufficient = 0;
  options.absolute_tolerance = 0.01 * p.q.norm();
  CHECK(solve().converged);
}
