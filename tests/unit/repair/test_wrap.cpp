#include "broken_meshes.hpp"
#include "repair/acceptance.hpp"
#include "repair/deviation.hpp"
#include "repair/wrap.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("a wrap encloses triangles at its distance and bridges gaps") {
  const TriangleMesh soup = soup_of(without(icosphere(2, 0.3), 0, 3));
  const std::optional<TriangleMesh> wrap = alpha_wrap(soup, 0.15, 0.02);
  REQUIRE(wrap);
  CHECK(check_acceptance(*wrap).accepted());
  CHECK(deviation(*wrap, icosphere(2, 0.3)) < 0.06);
  CHECK(closest_approach(*wrap, icosphere(2, 0.3)).distance() > 0.01);
}
