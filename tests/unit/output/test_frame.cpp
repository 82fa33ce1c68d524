#include "output_test.hpp"

using namespace bem;
using Catch::Matchers::Contains;
using test::error_message;

TEST_CASE("bodies with unusable names or triangles are refused") {
  const auto refused = [](const std::vector<TrajectoryBody>& bodies) {
    return error_message(ErrorCode::internal, [&] { check_bodies(bodies); });
  };
  CHECK_NOTHROW(check_bodies(test::sample_bodies()));
  for (const std::string name : {"", ".", "..", "a/b"})
    CHECK_THAT(refused({{name, 3, {{0, 1, 2}}}}), Contains("name"));
  CHECK_THAT(refused({{"a", 0, {}}, {"a", 0, {}}}), Contains("share a name"));
  CHECK_THAT(refused({{"a", 3, {{0, 1, 3}}}}), Contains("triangles"));
  CHECK_THAT(refused({{"a", 3, {{0, -1, 2}}}}), Contains("triangles"));
}

TEST_CASE("frames that do not fit the bodies are refused") {
  const auto bodies = test::sample_bodies();
  const auto refused = [&](const Frame& frame) {
    return error_message(ErrorCode::internal, [&] { check_frame(bodies, frame); });
  };
  Frame frame = test::sample_frame(0);
  CHECK_NOTHROW(check_frame(bodies, frame));
  frame.bodies[0].tractions.pop_back();
  CHECK_THAT(refused(frame), Contains("traction"));
  frame.bodies[1].positions.pop_back();
  frame.bodies[0].tractions = frame.bodies[0].positions;
  CHECK_THAT(refused(frame), Contains("position"));
  frame.bodies.pop_back();
  CHECK_THAT(refused(frame), Contains("every body"));
}
