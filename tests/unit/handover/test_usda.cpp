#include "handover/usda.hpp"
#include "handover/usda_text.hpp"
#include "sample_scene.hpp"

#include <catch2/catch.hpp>

using namespace bem;
using Catch::Matchers::Contains;

TEST_CASE("names of USD are identifiers and differ") {
  UsdaNames names;
  CHECK(names.unique("two words") == "two_words");
  CHECK(names.unique("two_words") == "two_words_2");
  CHECK(names.unique("two-words") == "two_words_3");
  CHECK(names.unique("3d") == "_3d");
  CHECK(names.unique("") == "_");
}

TEST_CASE("words of USD") {
  CHECK(usda_array({1, 0.5, -2, 1e-30}, 2) == "[(1, 0.5), (-2, 1e-30)]");
  CHECK(usda_array({0.1, 3}, 1) == "[0.1, 3]");
  CHECK(usda_array(std::vector<double>(), 3) == "[]");
  CHECK(usda_string("a \"b\" \\\n") == R"("a \"b\" \\\n")");
  RigidPlace place;
  place.translation = Vec3(1, 2, 3);
  place.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  CHECK(usda_matrix(place) == "( (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), (1, 2, 3, 1) )");
}

TEST_CASE("the rate of frames is a whole number where it nearly is one") {
  CHECK(frame_rate({0, 0.25, 0.5}) == 4);
  CHECK(frame_rate({0, 0.0334, 0.0666}) == 30);
  CHECK(frame_rate({0, 0.4}) == 2.5);
  CHECK(frame_rate({1}) == 24);
}

TEST_CASE("a scene as USD") {
  std::string text;
  write_usda(test::sample_scene(), [&](std::string_view piece) { text += piece; });
  CHECK_THAT(text, Contains("timeCodesPerSecond = 4\n") && Contains("endTimeCode = 2\n"));
  CHECK_THAT(text, Contains("def Mesh \"a_cube\" (") && Contains("string name = \"a cube\""));
  CHECK_THAT(text, Contains("faceVertexCounts = [4, 4, 4, 4, 4, 4]\n"));
  CHECK_THAT(text, Contains("            0: [(0, 0, 0), (1, 1, 1)],\n"));
  // corners without texture coordinates share one that is added
  CHECK_THAT(text, Contains("primvars:st = [(0, 0), (1, 0), (1, 1), (0, 0.25), (0, 0)]") &&
                       Contains("primvars:st:indices = [4, 4, 4, 4, 0, 1, 2, 3, 4, "));
  CHECK_THAT(text, Contains("primvars:heat.timeSamples = {\n            0: [0, 0"));
  CHECK_THAT(text, Contains("matrix4d xformOp:transform = ( (1, 0, 0, 0)"));
}
