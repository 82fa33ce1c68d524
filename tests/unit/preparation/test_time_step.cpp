#include "preparation/time_step.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("A wave crosses the body in about eight automatic time steps", "[time_step]") {
  CHECK(automatic_time_step({0.041}) == Approx(0.005));
  CHECK(automatic_time_step({0.0152}) == Approx(0.0015));
}

TEST_CASE("A stiff body beside a soft one does not make its history long", "[time_step]") {
  CHECK(automatic_time_step({0.15, 0.05}) == Approx(0.006));
  const double step = automatic_time_step({0.15, 1.5e-4});
  CHECK(step <= 0.15 / 30 * (1 + 1e-12));
  CHECK(step > 0.15 / 60);
}

TEST_CASE("The automatic time step is a whole part of the frame interval", "[time_step]") {
  const double step = automatic_time_step({0.041}, 1.0 / 60);
  CHECK(step <= 0.041 / 8);
  CHECK(1.0 / 60 / step == Approx(4));
  CHECK(automatic_time_step({}, 1.0 / 60) <= 0.01);
}

TEST_CASE("The automatic time step is at most a fiftieth of a second", "[time_step]") {
  CHECK(automatic_time_step({30}) == Approx(0.02));
}

TEST_CASE("The crossing time is that of shear waves", "[time_step]") {
  Material material;
  material.density = 1000;
  material.shear_modulus = 4000;  // 2 m/s
  CHECK(crossing_time(3, material) == Approx(1.5));
}
