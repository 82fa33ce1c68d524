#include "scene_examples.hpp"

#include <catch2/catch.hpp>

using bem::Vec3;

namespace {

/// A scene with a floor and a bowl whose body has this place; `more` follows (with a comma).
std::string scene_with_place(const std::string& place, const std::string& more = "") {
  return "{\"version\": 1, \"time_step\": 0.01, \"duration\": 1, \"obstacles\": [\n"
         "{\"name\": \"floor\", \"plane\": {\"point\": [0, 0, 0], \"normal\": [0, 3, 0]}},\n"
         "{\"name\": \"bowl\", \"mesh\": \"bowl.obj\"}],\n"
         "\"bodies\": [{\"name\": \"a\", \"archive\": \"a.bem\", \"place\":\n" +
         place + "}]" + more + "}";
}

bem::PlaceSpec place_of(const std::string& place, const std::string& more = "") {
  return *bem::parse_scene("s.json", scene_with_place(place, more)).bodies[0].place;
}

/// The error, without "s.json:LINE:COLUMN: /bodies/0/place".
std::string place_error(const std::string& place, const std::string& more = "") {
  const std::string message = bem::test::scene_error(scene_with_place(place, more));
  const std::string start = "/bodies/0/place";
  const auto at = message.find(start);
  return at == std::string::npos ? message : message.substr(at + start.size());
}

}  // namespace

TEST_CASE("a place is completed by its obstacle, the contact and gravity") {
  const bem::PlaceSpec on_floor =
      place_of(R"({"on": "floor"})", ", \"contact\": {\"tolerance\": 1e-4}");
  CHECK(on_floor.obstacle == 0);
  CHECK(on_floor.centre == Vec3(0, 0, 0));
  CHECK(*on_floor.gap == 1e-4);
  CHECK(*on_floor.direction == Vec3(0, -1, 0));
  const bem::PlaceSpec in_bowl = place_of(R"({"on": "bowl", "gap": 0, "center": ["1 cm", 2, 3]})",
                                          ", \"gravity\": [0, 0, -5]");
  CHECK(in_bowl.obstacle == 1);
  CHECK(in_bowl.centre == Vec3(0.01, 2, 3));
  CHECK(*in_bowl.gap == 0);
  CHECK(*in_bowl.direction == Vec3(0, 0, -1));
  CHECK(*place_of(R"({"on": "bowl", "direction": [5, 0, 0]})", ", \"gravity\": [0, 0, -5]")
             .direction == Vec3(1, 0, 0));
  CHECK(place_of(R"({"center": [1, 2, 3]})").on.empty());
}

TEST_CASE("copies of a placed body remember their offsets") {
  const bem::Scene scene = bem::parse_scene(
      "s.json",
      scene_with_place(R"({"on": "floor"}, "repeat": {"count": 2, "spacing": [1, 2, 3]})"));
  CHECK(scene.bodies[0].place->offset == Vec3(0, 0, 0));
  CHECK(scene.bodies[1].place->offset == Vec3(1, 2, 3));
  CHECK(scene.bodies[1].place->obstacle == 0);
}

TEST_CASE("places are checked") {
  CHECK(place_error("{}") == ": one of the keys on, center is required");
  CHECK(place_error(R"({"on": "flor"})") ==
        "/on: expected the name of an obstacle of this scene, found \"flor\"; did you mean "
        "\"floor\"?");
  CHECK(place_error(R"({"on": "a"})") ==
        "/on: expected the name of an obstacle of this scene, found \"a\"");
  CHECK(place_error(R"({"on": ""})") ==
        "/on: expected the name of an obstacle, found the string \"\"");
  CHECK(place_error(R"({"center": [0, 0, 0], "gap": 1})") ==
        "/gap: \"gap\" is allowed only beside \"on\"");
  CHECK(place_error(R"({"on": "floor", "gap": -1})") ==
        "/gap: expected a length >= 0, found the number -1");
  CHECK(place_error(R"({"on": "bowl"})") ==
        ": a scene without gravity needs a \"direction\" here, in which the body falls onto "
        "\"bowl\"");
  CHECK(place_error(R"({"on": "floor", "direction": [0, -1, 0]})") ==
        ": \"direction\" is for obstacles with a mesh; a body comes to lie on a plane along its "
        "normal");
  CHECK(place_error(R"({"on": "floor"}, "position": [0, 0, 0])") ==
        ": \"place\" is not allowed beside \"position\"");
}
