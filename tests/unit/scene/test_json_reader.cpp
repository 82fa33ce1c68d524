#include "scene/json_reader.hpp"
#include "scene_examples.hpp"

#include <catch2/catch.hpp>

using bem::JsonDocument;
using bem::JsonReader;
using bem::JsonValue;
using bem::test::message_of;

namespace {

/// The message of `get` applied to the JSON value `text`, without its place.
template <class Get>
std::string complaint(const std::string& text, const Get& get) {
  const JsonDocument document = JsonDocument::parse("f", text);
  const std::string message = message_of([&] { get(JsonValue(document, 0)); });
  REQUIRE((message.empty() || message.compare(0, 7, "f:1:1: ") == 0));
  return message.empty() ? "" : message.substr(7);
}

}  // namespace

TEST_CASE("typed values say what was expected and what was found") {
  const auto number = [](const JsonValue& v) { v.number(); };
  REQUIRE(complaint("1", number) == "");
  REQUIRE(complaint("\"1\"", number) == "expected a number, found the string \"1\"");
  REQUIRE(complaint("null", number) == "expected a number, found null");
  REQUIRE(complaint("[]", number) == "expected a number, found an empty array");
  REQUIRE(complaint("[1,2]", number) == "expected a number, found an array of length 2");
  REQUIRE(complaint("{}", number) == "expected a number, found an object");
  REQUIRE(complaint("false", number) == "expected a number, found false");

  const auto boolean = [](const JsonValue& v) { v.boolean(); };
  REQUIRE(complaint("true", boolean) == "");
  REQUIRE(complaint("0", boolean) == "expected true or false, found the number 0");

  const auto text = [](const JsonValue& v) { v.text(); };
  REQUIRE(complaint("\"x\"", text) == "");
  REQUIRE(complaint("1.5", text) == "expected a string, found the number 1.5");
}

TEST_CASE("ranges include and exclude their ends as they say") {
  const auto positive = [](const JsonValue& v) { v.positive(); };
  REQUIRE(complaint("1e-300", positive) == "");
  REQUIRE(complaint("0", positive) == "expected a number > 0, found the number 0");
  REQUIRE(complaint("1e-999", positive) == "expected a number > 0, found the number 0");
  REQUIRE(complaint("true", positive) == "expected a number > 0, found true");

  const auto non_negative = [](const JsonValue& v) { v.non_negative(); };
  REQUIRE(complaint("0", non_negative) == "");
  REQUIRE(complaint("-1e-9", non_negative) == "expected a number >= 0, found the number -1e-09");

  const auto half = [](const JsonValue& v) { v.number_in(0, 0.5); };
  REQUIRE(complaint("0", half) == "");
  REQUIRE(complaint("0.5", half) == "");
  REQUIRE(complaint("0.5000001", half) ==
          "expected a number from 0 to 0.5, found the number 0.5000001");
  REQUIRE(complaint("-0.1", half) == "expected a number from 0 to 0.5, found the number -0.1");
  REQUIRE(complaint("\"0\"", half) == "expected a number from 0 to 0.5, found the string \"0\"");

  const auto index = [](const JsonValue& v) { v.integer_in(1, 9); };
  REQUIRE(complaint("1", index) == "");
  REQUIRE(complaint("9.0", index) == "");
  REQUIRE(complaint("10", index) == "expected an integer from 1 to 9, found the number 10");
  REQUIRE(complaint("1.5", index) == "expected an integer from 1 to 9, found the number 1.5");
  REQUIRE(complaint("1e300", index) == "expected an integer from 1 to 9, found the number 1e+300");
}

TEST_CASE("vectors have three numbers, directions a length") {
  const auto vec3 = [](const JsonValue& v) { v.vec3(); };
  REQUIRE(complaint("[1,2,3]", vec3) == "");
  REQUIRE(complaint("[1,2]", vec3) ==
          "expected an array of three numbers, found an array of length 2");
  REQUIRE(complaint("7", vec3) == "expected an array of three numbers, found the number 7");
  const JsonDocument bad = JsonDocument::parse("f", "[1, 2, \"3\"]");
  REQUIRE(message_of([&] { JsonValue(bad, 0).vec3(); }) ==
          "f:1:8: /2: expected a number, found the string \"3\"");

  REQUIRE(complaint("[0,0,-0.0]", [](const JsonValue& v) { v.direction(); }) ==
          "expected a direction, found the zero vector");
  for (const char* text : {"[3e-320, 0, -4e-320]", "[3, 0, -4]", "[1.2e308, 0, -1.6e308]"}) {
    const JsonDocument d = JsonDocument::parse("f", text);
    REQUIRE((JsonValue(d, 0).direction() - bem::Vec3(0.6, 0, -0.8)).norm() < 1e-3);
  }
}

TEST_CASE("choices and keys that are misspelt are answered with the nearest") {
  const auto choice = [](const JsonValue& v) { v.choice({"moving", "static"}); };
  REQUIRE(complaint("\"static\"", choice) == "");
  REQUIRE(complaint("\"Static\"", choice) ==
          "expected one of the strings moving, static, found \"Static\"; did you mean \"static\"?");
  REQUIRE(complaint("\"no\"", choice) ==
          "expected one of the strings moving, static, found \"no\"");
}

TEST_CASE("a reader refuses the members that nobody asked for") {
  const JsonDocument d =
      JsonDocument::parse("f", "{\"mass\": 1,\n \"volume\": 2,\n  \"colour\": 3}");
  JsonReader reader(JsonValue(d, 0), "a thing");
  REQUIRE(reader.required("mass").number() == 1);
  REQUIRE(reader.optional("volume").has_value());
  REQUIRE_FALSE(reader.optional("color").has_value());
  REQUIRE(message_of([&] { reader.finish(); }) ==
          "f:3:3: /colour: unknown key; did you mean \"color\"? (allowed: mass, volume, color)");
  REQUIRE(reader.optional("colour").has_value());
  REQUIRE(message_of([&] { reader.finish(); }) == "");
}

TEST_CASE("a required key that is misspelt is named, one that is missing too") {
  const JsonDocument d = JsonDocument::parse("f", "{\"x\": {\n\"masss\": 1}}");
  JsonReader reader(JsonValue(d, *d.find("/x")), "a thing");
  REQUIRE(message_of([&] { reader.required("mass"); }) ==
          "f:2:1: /x/masss: unknown key; did you mean \"mass\"?");
  REQUIRE(message_of([&] { reader.required("volume"); }) ==
          "f:1:7: /x: the required key \"volume\" is missing");
  REQUIRE(message_of([&] { JsonReader(JsonValue(d, 2), "a thing"); }) ==
          "f:2:10: /x/masss: expected a thing (an object), found the number 1");
}

TEST_CASE("of keys that exclude each other exactly one is there") {
  const auto one = [](const JsonValue& v) {
    JsonReader(v, "x").required_one_of({"first", "last"});
  };
  REQUIRE(complaint("{\"first\": 1}", one) == "");
  REQUIRE(complaint("{}", one) == "one of the keys first, last is required");
  const JsonDocument both = JsonDocument::parse("f", "{\"last\": 1,\n\"first\": 2}");
  REQUIRE(message_of([&] { one(JsonValue(both, 0)); }) ==
          "f:1:2: /last: \"last\" is not allowed beside \"first\"");
  const JsonDocument misspelt = JsonDocument::parse("f", "{\"lsat\": 1}");
  REQUIRE(message_of([&] { one(JsonValue(misspelt, 0)); }) ==
          "f:1:2: /lsat: unknown key; did you mean \"last\"?");
}
