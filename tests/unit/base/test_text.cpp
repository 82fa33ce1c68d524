#include "base/text.hpp"

#include <catch2/catch.hpp>

using namespace bem;

TEST_CASE("numbers read back exactly") {
  CHECK(to_text(0.1) == "0.1");
  CHECK(std::stod(to_text(1.0 / 3.0)) == 1.0 / 3.0);
  CHECK(rounded_text(1.0 / 3.0, 2) == "0.33");
}

TEST_CASE("shares are written in per cent") {
  CHECK(percent_text(0.0283) == "2.8 %");
  CHECK(percent_text(0.997) == "99.7 %");
  CHECK(percent_text(1.04) == "104 %");
}

TEST_CASE("counts agree with their noun") {
  CHECK(count_text(1, "edge") == "1 edge");
  CHECK(count_text(3, "such edge") == "3 such edges");
  CHECK(count_text(1, "vertex") == "1 vertex");
  CHECK(count_text(2, "such vertex") == "2 such vertices");
}

TEST_CASE("bytes and seconds have units that people read") {
  CHECK(bytes_text(0) == "0 B");
  CHECK(bytes_text(999.4) == "999 B");
  CHECK(bytes_text(3.24e9) == "3.24 GB");
  CHECK(bytes_text(512e6) == "512 MB");
  CHECK(bytes_text(7e18) == "7000000 TB");
  CHECK(seconds_text(0.84) == "0.8 s");
  CHECK(seconds_text(200) == "3 min 20 s");
  CHECK(seconds_text(7500) == "2 h 5 min");
}
