#include "friction/block_system.hpp"
#include "support/friction_problems.hpp"
#include "support/uniform.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

double residual(const FrictionProblem& problem, const std::vector<int>& active) {
  test::Uniform uniform(9);
  std::vector<Mat3> left(problem.contacts()), own(problem.contacts());
  for (std::vector<Mat3>* blocks : {&left, &own})
    for (Mat3& block : *blocks)
      for (double& value : block.reshaped()) value = uniform();
  for (Mat3& block : own) block += 5 * Mat3::Identity();

  const Eigen::MatrixXd w = test::full_matrix(problem);
  const Eigen::Index n = static_cast<Eigen::Index>(3 * active.size());
  Eigen::MatrixXd m(n, n);
  for (std::size_t a = 0; a < active.size(); ++a)
    for (std::size_t b = 0; b < active.size(); ++b) {
      Mat3 block = left[active[a]] * w.block<3, 3>(3 * active[a], 3 * active[b]);
      if (a == b) block += own[active[a]];
      m.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) = block;
    }
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(n, -1, 2);
  Eigen::VectorXd x = right;
  BlockSystem system(problem);
  for (int twice = 0; twice < 2; ++twice) {
    REQUIRE(system.factorise(active, left, own));
    x = right;
    system.solve(x);
  }
  return (m * x - right).norm() / right.norm();
}

}  // namespace

TEST_CASE("block systems over all and over some contacts, dense and sparse") {
  const FrictionProblem dense = test::halfspace_problem(5, 0.3, 0.3, 1);
  const FrictionProblem sparse = test::stack_problem(20, 2, 0.3, 0.3);
  REQUIRE(sparse.blocks.size() < 0.25 * 80 * 80);
  for (const FrictionProblem* problem : {&dense, &sparse}) {
    std::vector<int> all, some;
    for (int i = 0; i < problem->contacts(); ++i) {
      all.push_back(i);
      if (i % 5 != 3) some.push_back(i);
    }
    CHECK(residual(*problem, all) < 1e-10);
    CHECK(residual(*problem, some) < 1e-10);
    CHECK(residual(*problem, {2}) < 1e-12);
  }
}

TEST_CASE("singular block systems are refused") {
  const FrictionProblem problem = test::halfspace_problem(2, 0.3, 0.3, 1);
  BlockSystem system(problem);
  const std::vector<Mat3> zero(4, Mat3::Zero());
  CHECK_FALSE(system.factorise({0, 1, 2, 3}, zero, zero));
  CHECK(system.factorise({}, zero, zero));
}
