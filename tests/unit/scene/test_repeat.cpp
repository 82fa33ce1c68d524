#include "scene_examples.hpp"

#include <random>
#include <set>

#include <catch2/catch.hpp>

using bem::Scene;
using bem::Vec3;
using bem::test::scene_with_body;

namespace {

Scene repeated(const std::string& members) {
  return bem::parse_scene("s.json", scene_with_body(members));
}

std::string error_of(const std::string& members) {
  return bem::test::scene_error(scene_with_body(members));
}

}  // namespace

TEST_CASE("an integer makes a row, three make a lattice") {
  const Scene row =
      repeated(R"(,"position": [1, 0, 0], "repeat": {"count": 3, "spacing": [0, "1 cm", 2]})");
  REQUIRE(row.bodies.size() == 3);
  CHECK(row.bodies[0].name == "a-0");
  CHECK(row.bodies[2].name == "a-2");
  CHECK(row.bodies[0].position == Vec3(1, 0, 0));
  CHECK(row.bodies[2].position == Vec3(1, 0.02, 4));
  CHECK(row.bodies[2].archive.written == "a.bem");

  const Scene lattice = repeated(R"(,"repeat": {"count": [2, 1, 3], "spacing": [1, 2, 3]})");
  REQUIRE(lattice.bodies.size() == 6);
  CHECK(lattice.bodies[0].name == "a-0-0-0");
  CHECK(lattice.bodies[1].name == "a-0-0-1");
  CHECK(lattice.bodies[5].name == "a-1-0-2");
  CHECK(lattice.bodies[5].position == Vec3(1, 0, 6));
}

TEST_CASE("obstacles are repeated, and joints name copies") {
  const Scene scene = bem::parse_scene("s.json", R"({"version": 1, "time_step": 1, "duration": 1,
    "bodies": [{"name": "a", "archive": "a", "repeat": {"count": 2, "spacing": [1, 0, 0]}}],
    "obstacles": [{"name": "p", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]},
                   "repeat": {"count": 2, "spacing": [0, 1, 0]}},
                  {"name": "m", "mesh": "m.obj", "repeat": {"count": 2, "spacing": [0, 1, 0],
                   "jitter": {"rotation_deg": 30}}}],
    "joints": [{"type": "weld", "a": {"body": "a-0"}, "b": {"body": "a-1"}}]})");
  REQUIRE(scene.obstacles.size() == 4);
  CHECK(scene.obstacles[1].name == "p-1");
  CHECK(std::get<bem::PlaneObstacle>(scene.obstacles[1].shape).point == Vec3(0, 1, 0));
  const auto& mesh = std::get<bem::MeshObstacle>(scene.obstacles[3].shape);
  CHECK(mesh.position == Vec3(0, 1, 0));
  CHECK(mesh.rotation.angle != 0);
  CHECK(scene.joints[0].b->body == 1);
}

TEST_CASE("jitter stays within its bounds and depends on the seed alone") {
  const std::string start =
      R"(,"rotation": {"axis": [0, 0, 1], "angle_deg": 50}, "repeat": {"count": [10, 10, 10], "spacing": [1, 1, 1], "jitter": {"position": "1 cm")";
  const Scene scene = repeated(start + R"(, "rotation_deg": 20, "seed": 7}})");
  const Scene again = repeated(start + R"(, "rotation_deg": 20, "seed": 7}})");
  const Scene other = repeated(start + R"(, "rotation_deg": 20, "seed": 8}})");
  const Scene straight = repeated(start + R"(, "seed": 7}})");
  const bem::Mat3 turned = scene.bodies[0].rotation.matrix();
  double farthest = 0, largest = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at(i / 100, i / 10 % 10, i % 10);
    const Vec3 shift = scene.bodies[i].position - at;
    mean += shift / 1000;
    farthest = std::max(farthest, shift.cwiseAbs().maxCoeff());
    const bem::Mat3 turn =
        scene.bodies[i].rotation.matrix() * straight.bodies[i].rotation.matrix().transpose();
    largest = std::max(largest, std::acos(std::min(1.0, (turn.trace() - 1) / 2)) * 180 / bem::kPi);
    CHECK(again.bodies[i].position == scene.bodies[i].position);
    CHECK(again.bodies[i].rotation.angle == scene.bodies[i].rotation.angle);
  }
  CHECK(farthest <= 0.01);
  CHECK(farthest > 0.0099);
  CHECK(largest <= 20.0001);
  CHECK(largest > 19.9);
  CHECK(mean.norm() < 0.001);
  CHECK(other.bodies[0].position != scene.bodies[0].position);
  CHECK(straight.bodies[0].position == scene.bodies[0].position);
  CHECK(straight.bodies[5].rotation.angle == 50 * (bem::kPi / 180));
  CHECK((turned * turned.transpose() - bem::Mat3::Identity()).norm() < 1e-14);
}

TEST_CASE("the generator is the standard's: its numbers do not change") {
  std::mt19937_64 random(7);
  const Vec3 first =
      repeated(
          R"(,"repeat": {"count": 1, "spacing": [1, 1, 1], "jitter": {"position": 1, "seed": 7}})")
          .bodies[0]
          .position;
  for (int k = 0; k < 3; ++k)
    CHECK(first[k] == 2 * (static_cast<double>(random() >> 11) * 0x1p-53) - 1);
  std::mt19937_64 check;
  check.discard(9999);
  CHECK(check() == 9981545732273789042u);  // [rand.predef] of the C++ standard
}

TEST_CASE("repetitions are checked") {
  const std::string spacing = ", \"spacing\": [1, 1, 1]}";
  const auto count = [&](const std::string& n) {
    return error_of(",\"repeat\": {\"count\": " + n + spacing);
  };
  CHECK(count("0") ==
        "s.json:4:22: /bodies/0/repeat/count: expected an integer from 1 to 10000, found the "
        "number 0");
  CHECK(count("1e9") ==
        "s.json:4:22: /bodies/0/repeat/count: expected an integer from 1 to 10000, found the "
        "number 1e+09");
  CHECK(count("[10, 0, 1]") ==
        "s.json:4:27: /bodies/0/repeat/count/1: expected an integer from 1 to 10000, found the "
        "number 0");
  CHECK(count("[1000, 1000, 1000]") ==
        "s.json:4:22: /bodies/0/repeat/count: expected at most 10000 copies, found 1000000000");
  CHECK(count("[1, 2]").find("with at least 3 elements") != std::string::npos);
  CHECK(count("\"3\"").find("expected an integer, or three of them") != std::string::npos);
  CHECK(error_of(",\"repeat\": {\"count\": 2}") ==
        "s.json:4:12: /bodies/0/repeat: the required key \"spacing\" is missing");
  CHECK(error_of(",\"repeat\": {\"count\": 2, \"spacing\": [0, \"1 s\", 0]}")
            .find("expected a length, found a time") != std::string::npos);
}

TEST_CASE("names of copies collide with others, and have to be short") {
  CHECK(bem::test::scene_error(
            "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1,\n\"bodies\": [\n"
            "{\"name\": \"a-1\", \"archive\": \"a.bem\"},\n"
            "{\"name\": \"a\", \"archive\": \"a.bem\", \"repeat\": {\"count\": 2, \"spacing\": [1, "
            "0, 0]}}]}") ==
        "s.json:4:10: /bodies/1/name: the name \"a-1\" is already used at /bodies/0/name");
  const std::string name(199, 'n');
  CHECK(bem::test::scene_error(
            "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1, \"bodies\": [{\"name\": \"" +
            name + "\", \"archive\": \"a\", \"repeat\": {\"count\": 2, \"spacing\": [1, 0, 0]}}]}")
            .find("of a copy has more than 200 bytes") != std::string::npos);
}
