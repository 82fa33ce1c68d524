#include "base/denormals.hpp"

#include <limits>

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("numbers too small for full precision are flushed within a scope only") {
  volatile float small = std::numeric_limits<float>::min();
  volatile float half = 0.5F;
  CHECK(small * half > 0);
  volatile float denormal = small * half;
  {
    const FlushDenormals flush;
    CHECK(small * half == 0);     // results
    CHECK(denormal * 2.0F == 0);  // operands
    {
      const FlushDenormals again;
      CHECK(small * half == 0);
    }
    CHECK(small * half == 0);
    CHECK(small * 2.0F > small);
  }
  CHECK(small * half > 0);
}
