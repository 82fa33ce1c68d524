#include "base/error.hpp"
#include "friction/contact_set.hpp"
#include "support/friction_problems.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("contacts that act on each other form sets") {
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(15, 15);
  for (int i = 0; i < 5; ++i) w.block<3, 3>(3 * i, 3 * i) = (i + 1) * Mat3::Identity();
  w(0, 12) = 0.5;   // 4 acts on 0, one way only
  w(11, 5) = 0.25;  // 1 acts on 3
  const FrictionProblem p = test::friction_problem(w, Eigen::VectorXd::LinSpaced(15, 1, 15),
                                                   Eigen::VectorXd::Constant(5, 0.3));
  CHECK(p.blocks.size() == 7);
  const std::vector<ContactSet> sets = connected_sets(p);
  REQUIRE(sets.size() == 3);
  CHECK(sets[0].contacts == std::vector<int>{0, 4});
  CHECK(sets[1].contacts == std::vector<int>{1, 3});
  CHECK(sets[2].contacts == std::vector<int>{2});
  for (const ContactSet& set : sets) {
    CHECK(set.problem.q.norm() == Approx(1));
    CHECK(set.scale.mean() == Approx(1));
    CHECK(set.finite);
  }
  // units: W_ii of contact 4 is 5, the mean of the set 3
  CHECK(sets[0].scale[1] == Approx(5.0 / 3));
  CHECK(sets[0].force_unit == Approx(sets[0].displacement_unit / 3));
}

TEST_CASE("problems that are not well formed are refused") {
  const FrictionProblem good = test::halfspace_problem(2, 0.3, 0.3, 1);
  CHECK_NOTHROW(check_problem(good));
  FrictionProblem bad = good;
  bad.mu[1] = -0.1;
  CHECK_THROWS_AS(check_problem(bad), Error);
  bad = good;
  std::swap(bad.columns[0], bad.columns[1]);
  CHECK_THROWS_AS(check_problem(bad), Error);
  bad = good;
  bad.q.conservativeResize(9);
  CHECK_THROWS_AS(check_problem(bad), Error);
  bad = good;
  bad.row_start[1] = 0;  // the first contact has no block of its own
  CHECK_THROWS_AS(check_problem(bad), Error);
}
