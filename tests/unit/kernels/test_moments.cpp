#include "kernels/moments.hpp"
#include "support/reference.hpp"

#include <catch2/catch.hpp>

using namespace bem_test;

TEST_CASE("moments of the exponential agree with the high-precision reference") {
  const auto relative = [](bem::Complex value, bem::Complex exact) {
    return std::abs(value - exact) / std::abs(exact);
  };
  const json data = load_reference("moments.json");
  REQUIRE(data["points"].size() == 39);
  double worst = 0, worst_m3 = 0;
  for (const json& p : data["points"]) {
    const bem::Moments m = bem::exponential_moments(complex(p["z"]));
    worst = std::max({worst, relative(m.e, complex(p["e"])), relative(m.m0, complex(p["M0"])),
                      relative(m.m1, complex(p["M1"]))});
    worst_m3 = std::max(worst_m3, relative(m.m3, complex(p["M3"])));
  }
  CHECK(worst < 5e-16);
  CHECK(worst_m3 < 1.5e-15);
}

TEST_CASE("moments are continuous where the series hands over to the recurrence") {
  for (double argument : {0.0, 0.7, 1.5}) {
    const bem::Complex direction = std::polar(1.0, argument);
    const bem::Moments below = bem::exponential_moments(direction * (2.0 - 1e-15));
    const bem::Moments above = bem::exponential_moments(direction * (2.0 + 1e-15));
    CHECK(std::abs(below.m2 - above.m2) < 2e-15);
    CHECK(std::abs(below.m3 - above.m3) < 2e-15);
  }
}
