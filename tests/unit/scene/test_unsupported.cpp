#include "scene/unsupported.hpp"
#include "scene_examples.hpp"

#include <catch2/catch.hpp>

using bem::test::scene_with;

namespace {

std::string unsupported(const std::string& text) {
  const auto part = bem::first_unsupported(bem::parse_scene("s.json", text));
  return part ? bem::error_at(part->first, part->second).what() : "";
}

}  // namespace

TEST_CASE("parts that are not simulated yet are named with their place") {
  REQUIRE(unsupported(scene_with("")) == "");
  REQUIRE(unsupported(scene_with(",\"contact\": {\"enabled\": false},"
                                 "\"output\": {\"formats\": [\"obj\", \"hdf5\"]}")) == "");
  REQUIRE(unsupported(scene_with(",\"output\": {\"formats\": [\"hdf5\", \"vtp\"]}")) ==
          "s.json:2:12: /output: the output format vtp is not yet supported");
  REQUIRE(unsupported(scene_with(",\"output\": {\"formats\": [\"pc2\"]}")) ==
          "s.json:2:12: /output: the output format pc2 is not yet supported");
}
