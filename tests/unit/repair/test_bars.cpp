#include "broken_meshes.hpp"
#include "repair/bars.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("bars join each solid with the nearest of the others") {
  const TriangleMesh three = both(both(cube(), cube(), {5, 0, 0}), cube(), {2, 0, 0});
  const Bars bars = joining_bars(make_surface(three, "three"), 0.1);
  CHECK(bars.count == 2);
  CHECK(bars.longest == Approx(2));
  const Surface surface = make_surface(bars.mesh, "bars");
  CHECK(surface.components.size() == 2);
  for (const Component& bar : surface.components) CHECK(bar.faces_outward());
}
