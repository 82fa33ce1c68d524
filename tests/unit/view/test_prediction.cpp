#include "prediction.hpp"
#include "unpacking.hpp"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace bem;

namespace {

using Levels = std::vector<std::uint16_t>;

/// Writes frames and reads them back; returns the bytes of base 64.
std::size_t round_trip(const std::vector<Levels>& frames, std::size_t components) {
  PredictedFrames predicted(components);
  for (const Levels& frame : frames) predicted.add(frame);
  PackedSection section;
  predicted.flush(section);
  const std::string text = section.text();
  test::Unpacked read(text, section.size());
  Levels all;
  for (const Levels& frame : frames) all.insert(all.end(), frame.begin(), frame.end());
  CHECK(read.frames(frames.size(), frames[0].size(), components) == all);
  CHECK(read.at_end());
  return text.size();
}

}  // namespace

TEST_CASE("differences are folded so that small ones are small", "[prediction]") {
  CHECK(folded(0) == 0);
  CHECK(folded(0xffff) == 1);
  CHECK(folded(1) == 2);
  CHECK(folded(0xfffe) == 3);
  CHECK(folded(0x7fff) == 0xfffe);
  CHECK(folded(0x8000) == 0xffff);
}

TEST_CASE("predicted frames are exact whatever they hold", "[prediction]") {
  std::mt19937 random(1);
  std::vector<Levels> frames(5, Levels(30));
  for (Levels& frame : frames)
    for (auto& number : frame) number = static_cast<std::uint16_t>(random());
  round_trip(frames, 3);
  round_trip(frames, 1);
  round_trip({{0, 65535, 0}, {65535, 0, 65535}, {0, 65535, 0}}, 3);
}

TEST_CASE("smooth motion takes a fraction of its bytes", "[prediction]") {
  std::vector<Levels> frames;
  for (int k = 0; k < 50; ++k) {
    Levels frame(3000);
    for (std::size_t i = 0; i < frame.size(); ++i)
      frame[i] = static_cast<std::uint16_t>(30000 + 20000 * std::sin(0.02 * k + 0.1 * double(i)));
    frames.push_back(frame);
  }
  CHECK(round_trip(frames, 3) < frames.size() * 3000 * 2 / 3);  // of base 64, which adds a third
}

TEST_CASE("a segment does not need the one before", "[prediction]") {
  PredictedFrames predicted(3);
  PackedSection first, second;
  predicted.add({5, 6, 7});
  predicted.flush(first);
  predicted.add({1, 2, 3, 4, 5, 6});
  predicted.flush(second);
  test::Unpacked read(second.text(), second.size());
  CHECK(read.frames(1, 6, 3) == Levels{1, 2, 3, 4, 5, 6});
}
