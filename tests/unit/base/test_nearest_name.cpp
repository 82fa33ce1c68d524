#include "base/nearest_name.hpp"

#include <catch2/catch.hpp>

TEST_CASE("The nearest name is the one that was likely meant") {
  REQUIRE(bem::nearest_name("gravty", {"friction", "gravity"}) == "gravity");
  REQUIRE(bem::nearest_name("garvity", {"gravity"}) == "gravity");
  REQUIRE(bem::nearest_name("angle", {"axis", "angle_deg"}) == "angle_deg");
  REQUIRE(bem::nearest_name("an", {"an_axis"}) == "");
  REQUIRE(bem::nearest_name("mass", {"normal"}) == "");
  REQUIRE(bem::nearest_name("a", {"b"}) == "");
  REQUIRE(bem::nearest_name("", {"b"}) == "");
  REQUIRE(bem::nearest_name("fixedd", {"fields", "fixed"}) == "fixed");
  REQUIRE(bem::nearest_name("--thread", {"--dt", "--threads", "--the"}) == "--threads");
}
