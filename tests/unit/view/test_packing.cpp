#include "packing.hpp"
#include "unpacking.hpp"

#include <catch2/catch.hpp>

using namespace bem;

namespace {

std::string base64_of(const std::string& text) {
  return base64({text.begin(), text.end()});
}

}  // namespace

TEST_CASE("base 64 is that of RFC 4648", "[packing]") {
  CHECK(base64_of("").empty());
  CHECK(base64_of("f") == "Zg==");
  CHECK(base64_of("fo") == "Zm8=");
  CHECK(base64_of("foo") == "Zm9v");
  CHECK(base64_of("foobar") == "Zm9vYmFy");
  CHECK(base64({0xff, 0xff, 0xfe, 0xfb}) == "///++w==");
}

TEST_CASE("a section gives its numbers back", "[packing]") {
  const std::vector<double> times{0, 0.1, 1e9};
  const std::vector<std::uint32_t> corners{7, 70000, 0xffffffff};
  const std::vector<std::uint16_t> levels{0, 256, 65535};
  PackedSection section;
  section.add(times);
  section.add(corners);
  section.add(to_floats(times));
  section.add(levels);
  REQUIRE(section.size() == 3 * (8 + 4 + 4 + 2));
  test::Unpacked read(section.text(), section.size());
  CHECK(read.numbers<double>(3) == times);
  CHECK(read.numbers<std::uint32_t>(3) == corners);
  CHECK(read.numbers<float>(3) == std::vector<float>{0, 0.1f, 1e9f});
  CHECK(read.numbers<std::uint16_t>(3) == levels);
  CHECK(read.at_end());
}
