#include "friction/second_order_cone.hpp"
#include "support/friction_problems.hpp"
#include "support/uniform.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using bem::test::Uniform;

namespace {

Vec3 inside(Uniform& uniform) {
  const Vec3 x(0, uniform(), uniform());
  return x + Vec3(x.norm() + uniform.between(1e-3, 1), 0, 0);
}

}  // namespace

TEST_CASE("Jordan algebra of the second-order cone") {
  Uniform uniform(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 x = inside(uniform), y = inside(uniform), b(uniform(), uniform(), uniform());
    CHECK(cone::product(x, cone::quotient(b, x)).isApprox(b, 1e-9));
    const cone::Scaling s = cone::nesterov_todd(y, x);
    CHECK((s.matrix * s.inverse).isIdentity(1e-9));
    CHECK((s.matrix * x).isApprox(s.inverse * y, 1e-9));
    CHECK(s.matrix.isApprox(s.matrix.transpose()));
    CHECK(cone::determinant(s.point) > 0);
  }
}

TEST_CASE("steps to the boundary of the second-order cone") {
  Uniform uniform(4);
  int bounded = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 x = inside(uniform), d(uniform(), uniform(), uniform());
    const double t = cone::step_to_boundary(x, d);
    CHECK(t > 0);
    if (t > 1e9) {
      CHECK(d[0] >= d.tail<2>().norm());
      continue;
    }
    ++bounded;
    const Vec3 end = x + t * d;
    CHECK(end[0] >= -1e-12);
    CHECK(std::abs(cone::determinant(end)) <= 1e-9 * (1 + end.squaredNorm()));
    const Vec3 middle = x + 0.5 * t * d;
    CHECK(cone::determinant(middle) > 0);
  }
  CHECK(bounded > 300);
  CHECK(cone::step_to_boundary(Vec3(1, 0, 0), Vec3(-1, 0, 0)) == Approx(1));
  CHECK(cone::step_to_boundary(Vec3(1, 0, 0), Vec3(0, 0, 2)) == Approx(0.5));
}
