#include "base/error.hpp"
#include "friction/friction_solver.hpp"
#include "friction/natural_map.hpp"
#include "support/friction_problems.hpp"
#include "support/rigid_scene.hpp"

#include <limits>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

constexpr FrictionMethod kMethods[] = {FrictionMethod::staggered, FrictionMethod::nsgs,
                                       FrictionMethod::newton};
using Free = Eigen::Matrix<double, 6, 1>;

FrictionOptions options_of(FrictionMethod method, double tolerance = 1e-8) {
  FrictionOptions options;
  options.method = method;
  options.tolerance = tolerance;
  options.max_sweeps = 50000;
  return options;
}

Eigen::VectorXd displacements(const FrictionProblem& p, const Eigen::VectorXd& r) {
  Eigen::VectorXd u(p.q.size());
  for (int i = 0; i < p.contacts(); ++i) u.segment<3>(3 * i) = displacement(p, i, r);
  return u;
}

/// Sum of one component over the contacts.
double total(const Eigen::VectorXd& x, int component) {
  return Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>(x.data(), 3, x.size() / 3)
      .row(component)
      .sum();
}

/// Resultant tangential displacement lengths of all contacts.
double slip(const Eigen::VectorXd& u, int i) {
  return u.segment<2>(3 * i + 1).norm();
}

}  // namespace

TEST_CASE("a block on four points slides by what friction leaves of the push") {
  const double mass = 3, g = 9.81e-4, mu = 0.4;
  for (FrictionMethod method : kMethods)
    for (double angle : {0.0, 0.5, kPi / 4, 1.3})
      for (double push : {0.2, 0.39, 0.41, 0.9}) {  // times the weight
        test::RigidScene scene;
        Free free = Free::Zero();
        free.head<3>() << push * g * std::cos(angle), push * g * std::sin(angle), -g;
        const int block = scene.add_box({0, 0, 0.05}, {0.4, 0.4, 0.1}, mass, free);
        scene.add_face(block, test::RigidScene::kGround, {0, 0, 0}, 0.4, 0.4, 2, mu);
        const FrictionProblem p = scene.problem();
        Eigen::VectorXd r = Eigen::VectorXd::Zero(12);
        const FrictionResult result = solve_friction(p, r, options_of(method, 1e-10));
        CAPTURE(static_cast<int>(method), angle, push, result.error);
        REQUIRE(result.converged);
        CHECK(total(r, 0) == Approx(mass * g).epsilon(1e-7));
        const double friction = std::hypot(total(r, 1), total(r, 2));
        CHECK(friction == Approx(mass * g * std::min(push, mu)).epsilon(1e-6));
        const Eigen::VectorXd u = displacements(p, r);
        for (int i = 0; i < 4; ++i) {
          CHECK(std::abs(u[3 * i]) < 1e-8 * g);
          CHECK(slip(u, i) == Approx(std::max(0.0, push - mu) * g).margin(1e-7 * g));
        }
      }
}

TEST_CASE("a bar in a groove slides against the friction of both faces") {
  const double mass = 2, g = 9.81e-4, mu = 0.3;
  for (FrictionMethod method : kMethods)
    for (double push : {0.3, 0.6}) {
      test::RigidScene scene;
      Free free = Free::Zero();
      free.head<3>() << 0, push * g, -g;
      const int bar = scene.add_box({0, 0, 0}, {0.1, 0.4, 0.1}, mass, free);
      for (double side : {-1, 1})
        for (double y : {-0.2, 0.2})
          scene.add_contact(bar, test::RigidScene::kGround, {0.05 * side, y, -0.05}, {-side, 0, 1},
                            mu);
      const FrictionProblem p = scene.problem();
      Eigen::VectorXd r = Eigen::VectorXd::Zero(12);
      REQUIRE(solve_friction(p, r, options_of(method, 1e-10)).converged);
      // faces at 45 degrees: when the bar slides along the groove, the normal forces add up to
      // sqrt(2) times the weight
      const double limit = std::sqrt(2.0) * mu;
      const Eigen::VectorXd u = displacements(p, r);
      CAPTURE(static_cast<int>(method), push);
      for (int i = 0; i < 4; ++i)
        CHECK(slip(u, i) == Approx(std::max(0.0, push - limit) * g).margin(1e-7 * g));
      if (push > limit) CHECK(total(r, 0) == Approx(std::sqrt(2.0) * mass * g).epsilon(1e-6));
    }
}

TEST_CASE("a table on many legs stands still whatever the split of its weight") {
  const double g = 9.81e-4;
  for (FrictionMethod method : kMethods) {
    test::RigidScene scene;
    Free free = Free::Zero();
    free.head<3>() << 0.2 * g, 0, -g;
    const int table = scene.add_box({0, 0, 0.05}, {1, 1, 0.1}, 5, free);
    scene.add_face(table, test::RigidScene::kGround, {0, 0, 0}, 1, 1, 5, 0.5);
    const FrictionProblem p = scene.problem();
    Eigen::VectorXd r = Eigen::VectorXd::Zero(75);
    REQUIRE(solve_friction(p, r, options_of(method)).converged);
    CHECK(total(r, 0) == Approx(5 * g).epsilon(1e-6));
    CHECK(displacements(p, r).norm() < 1e-7 * g);
    for (int i = 0; i < 25; ++i) CHECK(r.segment<2>(3 * i + 1).norm() <= 0.5 * r[3 * i] + 1e-12);
  }
}

TEST_CASE("units do not matter") {
  for (FrictionMethod method : kMethods)
    for (FrictionProblem p :
         {test::halfspace_problem(5, 0.1, 0.8, 1), test::stack_problem(3, 2, 0.5, 0.8)}) {
      const FrictionOptions options = options_of(method, 1e-6);
      Eigen::VectorXd r = Eigen::VectorXd::Zero(p.q.size()), scaled = r;
      const FrictionResult result = solve_friction(p, r, options);
      for (Mat3& block : p.blocks) block *= 1048576.0;
      p.q *= std::ldexp(1.0, -30);
      const FrictionResult again = solve_friction(p, scaled, options);
      CHECK(result.converged);
      CHECK(again.sweeps == result.sweeps);
      CHECK(again.newton_steps == result.newton_steps);
      CHECK(again.error == Approx(result.error).epsilon(1e-6));
      CHECK(again.complementarity == Approx(result.complementarity).epsilon(1e-6));
      CHECK((std::ldexp(1.0, 50) * scaled - r).norm() <= 1e-9 * r.norm());
      // units that are no powers of two round otherwise but are solved as well
      for (Mat3& block : p.blocks) block *= 1e-9;
      p.q *= 1e3;
      scaled.setZero();
      CHECK(solve_friction(p, scaled, options).converged);
    }
}

TEST_CASE("without friction there are normal forces only") {
  const FrictionProblem p = test::halfspace_problem(6, 0, 0, 1);
  for (FrictionMethod method : kMethods) {
    Eigen::VectorXd r = Eigen::VectorXd::Zero(p.q.size());
    REQUIRE(solve_friction(p, r, options_of(method)).converged);
    const Eigen::VectorXd u = displacements(p, r);
    int touching = 0;
    for (int i = 0; i < p.contacts(); ++i) {
      CHECK(r.segment<2>(3 * i + 1) == Eigen::Vector2d::Zero());
      CHECK(std::min(r[3 * i], 10 * u[3 * i]) == Approx(0).margin(1e-6));
      touching += r[3 * i] > 1e-6;
    }
    CHECK(touching > 4);
    CHECK(touching < 36);
  }
}

TEST_CASE("a nearby start saves work") {
  const FrictionProblem p = test::stack_problem(6, 3, 0.5, 0.3);
  for (FrictionMethod method : {FrictionMethod::nsgs, FrictionMethod::newton}) {
    const FrictionOptions options = options_of(method, 1e-6);
    Eigen::VectorXd cold = Eigen::VectorXd::Zero(p.q.size());
    const FrictionResult first = solve_friction(p, cold, options);
    Eigen::VectorXd warm = cold;
    CHECK(solve_friction(p, warm, options).sweeps == 0);
    CHECK((warm - cold).norm() <= 1e-15 * cold.norm());  // but for the change of units and back
    warm = 1.001 * cold;
    const FrictionResult second = solve_friction(p, warm, options);
    CHECK(first.converged);
    CHECK(second.converged);
    CHECK(2 * (second.sweeps + 20 * second.newton_steps) <= first.sweeps + 20 * first.newton_steps);
  }
}

TEST_CASE("empty problems, open contacts, zero displacements") {
  Eigen::VectorXd none(0);
  CHECK(solve_friction(test::friction_problem(Eigen::MatrixXd(0, 0), none, none), none).converged);

  FrictionProblem p = test::halfspace_problem(3, 0.3, 0.3, 1);
  Eigen::VectorXd r = Eigen::VectorXd::Constant(27, 7);
  p.q.setZero();
  CHECK(solve_friction(p, r).converged);
  CHECK(r.isZero(1e-9));
  for (int i = 0; i < 9; ++i) p.q.segment<3>(3 * i) << 1, 2, 3;
  r.setConstant(7);
  const FrictionResult result = solve_friction(p, r);
  CHECK(result.converged);
  CHECK(result.penetration == 0);
  CHECK(r.isZero(0));
  Eigen::VectorXd wrong(3);
  CHECK_THROWS_AS(solve_friction(p, wrong), Error);
}

TEST_CASE("the absolute tolerance accepts displacements that do not matter") {
  const FrictionProblem p = test::stack_problem(6, 3, 0.5, 0.3);
  FrictionOptions options;
  options.absolute_tolerance = 2 * p.q.norm();
  Eigen::VectorXd r = Eigen::VectorXd::Zero(p.q.size());
  const FrictionResult result = solve_friction(p, r, options);
  CHECK(result.converged);
  CHECK(result.sweeps == 0);
}

TEST_CASE("problems without a solution end with finite forces and say so") {
  const Vec3 up = Vec3::UnitZ();
  for (FrictionMethod method : kMethods) {
    FrictionOptions options;
    options.method = method;
    // a rigid box between two walls that leave less room than it needs
    test::RigidScene scene;
    Free free = Free::Zero();
    const int box = scene.add_box({0, 0, 0}, {1, 1, 1}, 1, free);
    scene.add_contact(box, test::RigidScene::kGround, {0, 0, -0.5}, up, 0.3);
    scene.add_contact(box, test::RigidScene::kGround, {0, 0, 0.5}, -up, 0.3);
    FrictionProblem p = scene.problem();
    p.q[0] = p.q[3] = -1e-3;
    Eigen::VectorXd r = Eigen::VectorXd::Zero(6);
    FrictionResult result = solve_friction(p, r, options);
    CAPTURE(static_cast<int>(method), r.transpose());
    CHECK_FALSE(result.converged);
    CHECK(r.allFinite());
    CHECK(std::isfinite(result.error));
    CHECK(result.error > 0.1);

    // a compliance of zero: solvable only where the contact is open
    p = test::friction_problem(Eigen::MatrixXd::Zero(6, 6), Eigen::VectorXd::Constant(6, 1e-3),
                               Eigen::VectorXd::Constant(2, 0.5));
    r.setZero();
    CHECK(solve_friction(p, r, options).converged);
    p.q[3] = -1e-3;
    result = solve_friction(p, r, options);
    CHECK_FALSE(result.converged);
    CHECK(r.allFinite());
    CHECK(result.penetration == Approx(1e-3));
  }
}

TEST_CASE("numbers that are not finite stay in their set") {
  FrictionProblem p =
      test::friction_problem(Eigen::MatrixXd::Identity(9, 9), Eigen::VectorXd::Constant(9, -1),
                             Eigen::VectorXd::Constant(3, 0.5));
  p.q[4] = std::numeric_limits<double>::quiet_NaN();
  Eigen::VectorXd r = Eigen::VectorXd::Constant(9, std::numeric_limits<double>::infinity());
  const FrictionResult result = solve_friction(p, r);
  CHECK_FALSE(result.converged);
  CHECK(r.allFinite());
  CHECK(r.segment<3>(3) == Vec3::Zero());
  CHECK(r[0] == Approx(1));
  CHECK(r[6] == Approx(1));
}
