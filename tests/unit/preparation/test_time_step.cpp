#include "mesh/shapes.hpp"
#include "preparation/time_step.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("The automatic time step is what a wave takes along an edge, rounded down",
          "[time_step]") {
  CHECK(automatic_time_step({{0.0051, 0.1}}) == Approx(0.005));
  CHECK(automatic_time_step({{0.0019, 0.02}}) == Approx(0.0015));
}

TEST_CASE("An impact has at least sixteen steps, however coarse the mesh is", "[time_step]") {
  CHECK(automatic_time_step({{0.01, 0.016}}) == Approx(0.002));
}

TEST_CASE("A stiff body beside a soft one does not make its history long", "[time_step]") {
  const WaveTimes soft{0.01, 0.15}, stiff{1e-5, 1.5e-4};
  const double step = automatic_time_step({soft, stiff});
  CHECK(step <= 0.15 / 30);
  CHECK(step > 0.15 / 60);
}

TEST_CASE("The automatic time step is a whole part of the frame interval", "[time_step]") {
  const double step = automatic_time_step({{0.0051, 0.1}}, 1.0 / 60);
  CHECK(step <= 0.0051);
  CHECK(1.0 / 60 / step == Approx(4));
  CHECK(automatic_time_step({}, 1.0 / 60) <= 0.01);
}

TEST_CASE("The automatic time step is at most a fiftieth of a second", "[time_step]") {
  CHECK(automatic_time_step({{3, 30}}) == Approx(0.02));
}

TEST_CASE("Wave times are those of the median edge and the extent", "[time_step]") {
  Material material;
  material.density = 1000;
  material.shear_modulus = 4000;  // 2 m/s
  const TriangleMesh mesh = box(Vec3(1, 1, 1), {2, 2, 2});
  const WaveTimes times = wave_times(mesh, 3, material);
  CHECK(times.edge == Approx(0.25).epsilon(0.5));
  CHECK(times.extent == Approx(1.5));
}
