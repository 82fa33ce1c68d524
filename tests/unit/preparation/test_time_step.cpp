#include "preparation/time_step.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("A wave crosses the body in about eight automatic time steps", "[time_step]") {
  CHECK(automatic_time_step({0.041}).seconds == Approx(0.005));
  CHECK(automatic_time_step({0.0152}).seconds == Approx(0.0015));
}

TEST_CASE("A stiff body beside a soft one does not make its history long", "[time_step]") {
  CHECK(automatic_time_step({0.15, 0.05}).seconds == Approx(0.006));
  const double step = automatic_time_step({0.15, 1.5e-4}).seconds;
  CHECK(step <= 0.15 / 30 * (1 + 1e-12));
  CHECK(step > 0.15 / 60);
}

TEST_CASE("The automatic time step is a whole part of the frame interval", "[time_step]") {
  const double step = automatic_time_step({0.041}, 1.0 / 60).seconds;
  CHECK(step <= 0.041 / 8);
  CHECK(1.0 / 60 / step == Approx(4));
  CHECK(automatic_time_step({}, 1.0 / 60).seconds <= 0.01);
}

TEST_CASE("The automatic time step is at most a fiftieth of a second", "[time_step]") {
  CHECK(automatic_time_step({30}).seconds == Approx(0.02));
}

TEST_CASE("The reason of an automatic time step is what limits it", "[time_step]") {
  const auto reason = [](const std::vector<double>& crossings, std::optional<double> frames = {}) {
    return automatic_time_step(crossings, frames).reason;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(reason({0.041}), Contains("eight of which a shear wave crosses the body"));
  CHECK_THAT(reason({0.15, 0.05}), Contains("eight of which") && Contains("fastest"));
  CHECK_THAT(reason({0.15, 1.5e-4}), Contains("thirty of which") && Contains("slowest"));
  CHECK(reason({30}) == ", the longest that is chosen by itself");
  CHECK(reason({}) == ", because no body deforms");
  CHECK_THAT(reason({0.041}, 1.0 / 60), Contains("eight") && Contains("4 of them lead from one"));
  CHECK(reason({0.041}, 0.001) == ", as it is from one frame to the next");
}

TEST_CASE("The crossing time is that of shear waves", "[time_step]") {
  Material material;
  material.density = 1000;
  material.shear_modulus = 4000;  // 2 m/s
  CHECK(crossing_time(3, material) == Approx(1.5));
}
