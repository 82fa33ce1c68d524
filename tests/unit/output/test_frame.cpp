#include "output_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using test::error_message;

TEST_CASE("bodies with unusable names or triangles are refused") {
  const auto refused = [](const std::vector<TrajectoryBody>& bodies) {
    return error_message(ErrorCode::internal, [&] { check_contents(bodies); });
  };
  CHECK_NOTHROW(check_contents(test::sample_bodies()));
  for (const std::string name : {"", ".", "..", "a/b"})
    CHECK_THAT(refused({{name, 3, {{0, 1, 2}}}}), Contains("name"));
  CHECK_THAT(refused({{"a", 0, {}}, {"a", 0, {}}}), Contains("share a name"));
  CHECK_THAT(refused({{"a", 3, {{0, 1, 3}}}}), Contains("triangles"));
  CHECK_THAT(refused({{"a", 3, {{0, -1, 2}}}}), Contains("triangles"));
}

TEST_CASE("frames that do not fit the bodies are refused") {
  const TrajectoryContents contents = test::sample_contents();
  const auto refused = [&](const Frame& frame) {
    return error_message(ErrorCode::internal, [&] { check_frame(contents, frame); });
  };
  Frame frame = test::sample_frame(0);
  CHECK_NOTHROW(check_frame(contents, frame));
  frame.bodies[0].fields[1].pop_back();
  CHECK_THAT(refused(frame), Contains("fields at every vertex"));
  frame.bodies[0].fields.pop_back();
  CHECK_THAT(refused(frame), Contains("every field"));
  frame = test::sample_frame(0);
  frame.bodies[0].series.pop_back();
  CHECK_THAT(refused(frame), Contains("series"));
  frame = test::sample_frame(0);
  frame.obstacles.emplace_back();
  CHECK_THAT(refused(frame), Contains("every obstacle"));
  frame = test::sample_frame(0);
  frame.bodies[1].positions.pop_back();
  CHECK_THAT(refused(frame), Contains("position"));
  frame.bodies.pop_back();
  CHECK_THAT(refused(frame), Contains("every body"));
}
