#include "broken_meshes.hpp"
#include "mesh/mass_properties.hpp"
#include "mesh/surface.hpp"
#include "repair/sheet.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using namespace bem::test;

TEST_CASE("a flat sheet becomes a plate of its thickness") {
  const Surface plate = make_surface(thicken(grid(3), 0.1), "plate");
  CHECK(mass_properties(plate.nodes, 1).volume == Approx(0.9));
  CHECK(plate.warnings.empty());
}
