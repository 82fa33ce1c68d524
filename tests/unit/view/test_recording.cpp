#include "recording.hpp"
#include "survey.hpp"

#include <catch2/catch.hpp>

using namespace bem;

using Frames = std::vector<std::size_t>;

TEST_CASE("frames are chosen by number and by rate", "[recording]") {
  std::vector<double> times;
  for (int k = 0; k < 11; ++k) times.push_back(5 + 0.01 * k);
  CHECK(chosen_frames(times, 1, 0).size() == 11);
  CHECK(chosen_frames(times, 4, 0) == Frames{0, 4, 8});
  CHECK(chosen_frames(times, 1, 50) == Frames{0, 2, 4, 6, 8, 10});
  CHECK(chosen_frames(times, 1, 30) == Frames{0, 3, 7, 10});
  CHECK(chosen_frames(times, 1, 1000).size() == 11);
  CHECK(chosen_frames({}, 1, 0).empty());
}

TEST_CASE("the tops of colours are round and not below", "[recording]") {
  CHECK(round_above(0) == 0);
  CHECK(round_above(1) == 1);
  CHECK(round_above(0.00013) == Approx(0.00015));
  CHECK(round_above(6.5e7) == Approx(8e7));
  CHECK(round_above(9) == Approx(10));
}

TEST_CASE("lengths of vectors", "[recording]") {
  CHECK(lengths({3, 4, 0, 0, 0, -2}, 3) == std::vector<double>{5, 2});
  CHECK(lengths({-3}, 1) == std::vector<double>{3});
}
