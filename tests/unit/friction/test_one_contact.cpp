#include "friction/natural_map.hpp"
#include "friction/one_contact.hpp"
#include "support/friction_problems.hpp"
#include "support/uniform.hpp"

#include <array>

#include <catch2/catch.hpp>

using namespace bem;
using bem::test::Uniform;

namespace {

/// Positive definite with smallest eigenvalue `least`, plus an antisymmetric part.
Mat3 random_block(Uniform& uniform, double least, double antisymmetric) {
  Mat3 a;
  for (double& value : a.reshaped()) value = uniform();
  Vec3 v(uniform(), uniform(), uniform());
  return a * a.transpose() + least * Mat3::Identity() + antisymmetric * cross_matrix(v);
}

/// All solutions, by scanning the angle of the friction force in 20,000 steps.
std::vector<Vec3> solutions_by_search(const Mat3& w, double mu, const Vec3& b) {
  std::vector<Vec3> found;
  if (b[0] >= 0) found.push_back(Vec3::Zero());
  const Vec3 stick = -w.inverse() * b;
  if (stick[0] > 0 && stick.tail<2>().norm() <= mu * stick[0]) found.push_back(stick);
  const int steps = 20000;
  double before = 0;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 2 * kPi * k / steps;
    const Vec3 d(1, mu * std::cos(angle), mu * std::sin(angle));
    const double n = -b[0] / w.row(0).dot(d);
    const Vec3 u = b + n * w * d;
    const double across = u[1] * d[2] - u[2] * d[1];
    // u_n = 0 by the choice of n; opposite directions are a sign change of the cross product
    if (k > 0 && n > 0 && (across > 0) != (before > 0) && u.tail<2>().dot(d.tail<2>()) < 0)
      found.push_back(n * d);
    before = across;
  }
  return found;
}

}  // namespace

TEST_CASE("one contact is solved exactly in every state") {
  Uniform uniform(5);
  std::array<int, 3> count{};  // open, sticking, sliding
  for (int trial = 0; trial < 4000; ++trial) {
    const Mat3 w = random_block(uniform, 0.1, trial % 2 == 0 ? 0 : 0.3);
    const double mu = uniform.between(0, 1.5);
    const Vec3 b(uniform.between(-1, 0.3), uniform(), uniform());
    const OneContact contact(w, mu, w.norm());
    const Vec3 r = contact.solve(b, Vec3(0.1 * (trial % 3), 0.1 * uniform(), 0.1 * uniform()));
    CAPTURE(trial, mu, b.transpose(), r.transpose());
    REQUIRE(natural_map(r, w * r + b, mu, w.norm()).norm() <= 1e-12 * (1 + r.norm()));
    const bool sliding = (w * r + b).tail<2>().norm() > 1e-9;
    ++count[b[0] >= 0 ? 0 : sliding ? 2 : 1];
  }
  for (int c : count) CHECK(c > 300);
}

TEST_CASE("the state of one contact is the one that a search finds") {
  Uniform uniform(6);
  int single = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const Mat3 w = random_block(uniform, 0.3, 0.2);
    const double mu = uniform.between(0.05, 1.2);
    const Vec3 b(uniform.between(-1, 0.1), uniform(), uniform());
    const Vec3 r = OneContact(w, mu, w.norm()).solve(b, Vec3::Zero());
    const std::vector<Vec3> expected = solutions_by_search(w, mu, b);
    REQUIRE_FALSE(expected.empty());
    double nearest = 1e300;
    for (const Vec3& e : expected) nearest = std::min(nearest, (r - e).norm());
    CAPTURE(trial, mu, b.transpose(), r.transpose());
    CHECK(nearest <= 2e-3 * (1 + r.norm()));
    single += expected.size() == 1;
  }
  CHECK(single > 100);
}

TEST_CASE("one contact without friction, and with singular blocks") {
  const Mat3 identity = Mat3::Identity();
  const Vec3 b(-2, 3, 4);
  CHECK(OneContact(identity, 0, 1).solve(b, Vec3::Zero()).isApprox(Vec3(2, 0, 0)));
  // no tangential compliance: the displacement is given, the force opposes it
  Mat3 normal_only = Mat3::Zero();
  normal_only(0, 0) = 4;
  CHECK(OneContact(normal_only, 0.5, 1)
            .solve(b, Vec3::Zero())
            .isApprox(Vec3(0.5, -0.25 * 0.6, -0.25 * 0.8), 1e-12));
  // of rank two: sticking is possible in a line of forces; one of them is found
  const Vec3 null = Vec3(0, 1, 1).normalized();
  const Mat3 plane = identity - null * null.transpose();
  const Vec3 in_range = plane * Vec3(-1, 0.2, 0.1);
  const Vec3 r = OneContact(plane, 0.9, 1).solve(in_range, Vec3::Zero());
  CHECK(natural_map(r, plane * r + in_range, 0.9, 1).norm() < 1e-6);
  // nothing can be done: finite all the same
  CHECK(OneContact(Mat3::Zero(), 0.5, 1).solve(b, Vec3::Zero()).allFinite());
  CHECK(OneContact(-identity, 0.5, 1).solve(b, Vec3::Zero()).allFinite());
}

TEST_CASE("projection onto the friction cone") {
  const double mu = 0.5;
  const Vec3 inside(1, 0.2, 0.3);
  CHECK(project_cone(inside, mu) == inside);
  CHECK(project_cone(Vec3(-1, 0.4, 0), mu) == Vec3::Zero());
  Uniform uniform(7);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 r(uniform(), uniform(), uniform());
    const Vec3 p = project_cone(r, mu), rest = r - p;
    CHECK(p.tail<2>().norm() <= mu * p[0] + 1e-15);
    CHECK(std::abs(p.dot(rest)) < 1e-15);
    CHECK(mu * rest.tail<2>().norm() * mu <= -rest[0] * mu + 1e-15);  // in the polar cone
  }
  CHECK(project_cone(Vec3(2, 1, 1), 0) == Vec3(2, 0, 0));
}
