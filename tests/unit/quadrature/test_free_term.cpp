#include "quadrature/free_term.hpp"
#include "quadrature/singular.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem_test;

TEST_CASE("solid angle, free term and principal value agree with the reference cones") {
  const json data = load_reference("freeterm.json");
  REQUIRE(data["cones"].size() == 21);
  double worst = 0;
  for (const json& cone : data["cones"]) {
    const double nu = number(cone["nu"]);
    const double kappa = (1 - 2 * nu) / (2 * (1 - nu));
    const bem::Vec3 x = vec3(cone["vertex"]);
    std::vector<bem::Vec3> ring;
    for (const json& p : cone["ring"]) ring.push_back(vec3(p));
    worst =
        std::max(worst, std::abs(bem::interior_solid_angle(x, ring) - number(cone["solid_angle"])));
    worst = std::max(worst, (bem::free_term(x, ring, kappa) - matrix3(cone["c"])).norm());
    bem::Mat3 own = bem::Mat3::Zero();
    for (std::size_t i = 0; i < ring.size(); ++i)
      own +=
          bem::VertexTriangle(x, ring[i], ring[(i + 1) % ring.size()]).static_traction_own(kappa);
    worst = std::max(worst, (own - matrix3(cone["cpv_own_block"])).norm());
  }
  CHECK(worst < 3e-15);
}

TEST_CASE("free terms of cube corners and edges have their known values") {
  // corner of the cube [0,1]^3 at the origin: c has 1/8 on the diagonal, 0.0568410 off it (nu 0.3)
  const double kappa = (1 - 0.6) / (2 * 0.7);
  const std::vector<bem::Vec3> corner = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  const bem::Mat3 c = bem::free_term(bem::Vec3::Zero(), corner, kappa);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      CHECK(std::abs(c(i, j)) == Approx(i == j ? 0.125 : 0.0568410).margin(1e-7));
}
