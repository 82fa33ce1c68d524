#include "scene/json_document.hpp"
#include "scene_examples.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

using bem::JsonDocument;
using bem::Location;
using bem::test::message_of;

namespace {

std::string parse_error(const std::string& text) {
  return message_of([&] { JsonDocument::parse("f.json", text); });
}

std::string place(const JsonDocument& document, const std::string& pointer) {
  const auto id = document.find(pointer);
  if (!id) return "nowhere";
  return bem::where(document.location(*id)) + " | " + bem::where(document.key_location(*id));
}

}  // namespace

TEST_CASE("every value of a document knows its line, column and pointer") {
  const std::string text =
      "\n { \"a\" : [1,\t-2.5e3 ,\r\n [ ] ,{\"b/c~d\":true}],\n"
      "\"t\\\"}]\\\\\": \"x\\u00e9\\\"\", \"\xC3\xA9\xC3\xA9\" : null, \"e\":{}}  \n";
  const JsonDocument d = JsonDocument::parse("f.json", text);
  REQUIRE(place(d, "") == "f.json:2:2 | f.json:2:2");
  REQUIRE(place(d, "/a") == "f.json:2:10: /a | f.json:2:4: /a");
  REQUIRE(place(d, "/a/0") == "f.json:2:11: /a/0 | f.json:2:11: /a/0");
  REQUIRE(place(d, "/a/1") == "f.json:2:14: /a/1 | f.json:2:14: /a/1");
  REQUIRE(place(d, "/a/2") == "f.json:3:2: /a/2 | f.json:3:2: /a/2");
  REQUIRE(place(d, "/a/3/b~1c~0d") == "f.json:3:16: /a/3/b~1c~0d | f.json:3:8: /a/3/b~1c~0d");
  REQUIRE(place(d, "/t\"}]\\") == "f.json:4:12: /t\"}]\\ | f.json:4:1: /t\"}]\\");
  REQUIRE(place(d, "/\xC3\xA9\xC3\xA9") ==
          "f.json:4:32: /\xC3\xA9\xC3\xA9 | f.json:4:25: /\xC3\xA9\xC3\xA9");
  REQUIRE(place(d, "/e") == "f.json:4:42: /e | f.json:4:38: /e");
  for (const char* absent : {"/a/4", "/a/-1", "/b", "a", "/", "/a/", "/e/0"})
    REQUIRE_FALSE(d.find(absent).has_value());
}

TEST_CASE("values keep their kind and content") {
  const JsonDocument d = JsonDocument::parse(
      "f", "[null, true, false, -7, 18446744073709551615, 0.1, \"s\\n\", [1,2], {\"k\":1}]");
  const auto& node = [&](int i) { return d.node(*d.find("/" + std::to_string(i))); };
  REQUIRE(node(0).kind == bem::JsonKind::null);
  REQUIRE(node(1).boolean);
  REQUIRE(node(2).kind == bem::JsonKind::boolean);
  REQUIRE_FALSE(node(2).boolean);
  REQUIRE(node(3).number == -7);
  REQUIRE(node(4).number == 18446744073709551615.0);
  REQUIRE(node(5).number == 0.1);
  REQUIRE(d.string(node(6).text) == "s\n");
  REQUIRE(node(7).count == 2);
  REQUIRE(node(8).kind == bem::JsonKind::object);
  REQUIRE(d.node(0).count == 9);
}

TEST_CASE("a byte order mark is skipped and does not move the columns") {
  const JsonDocument d = JsonDocument::parse("f", "\xEF\xBB\xBF[1, 2]");
  REQUIRE(place(d, "/1") == "f:1:5: /1 | f:1:5: /1");
}

TEST_CASE("what is not JSON is refused where it stops being JSON") {
  REQUIRE_THAT(parse_error(""), Catch::StartsWith("f.json:1:1: not valid JSON: "));
  REQUIRE_THAT(parse_error("{\n  \"a\": 1,\n}"), Catch::StartsWith("f.json:3:1: not valid JSON: "));
  REQUIRE_THAT(parse_error("{\"a\": 1\n"), Catch::StartsWith("f.json:2:1: not valid JSON: "));
  REQUIRE_THAT(parse_error("[1] 2"), Catch::StartsWith("f.json:1:5: not valid JSON: "));
  REQUIRE_THAT(parse_error("[1, // one\n2]"), Catch::StartsWith("f.json:1:5: not valid JSON: "));
  REQUIRE_THAT(parse_error("[NaN]"), Catch::StartsWith("f.json:1:2: not valid JSON: "));
  REQUIRE_THAT(parse_error("[-Infinity]"), Catch::StartsWith("f.json:1:3: not valid JSON: "));
  REQUIRE_THAT(parse_error("[01]"), Catch::StartsWith("f.json:1:3: not valid JSON: "));
  REQUIRE_THAT(parse_error("[\"a\xFF\"]"), Catch::StartsWith("f.json:1:4: not valid JSON: "));
  REQUIRE_THAT(parse_error("[\"a\nb\"]"), Catch::StartsWith("f.json:1:4: not valid JSON: "));
  REQUIRE_THAT(parse_error("{'a': 1}"), Catch::StartsWith("f.json:1:2: not valid JSON: "));
  REQUIRE(parse_error(std::string("{}\0", 3)) == "f.json:1:3: not valid JSON: a zero byte");
}

TEST_CASE("messages hold no control characters and no broken UTF-8") {
  const std::string message = parse_error("[\"\xFF\x1b[31m\"]");
  REQUIRE_FALSE(message.empty());
  for (char c : message) REQUIRE((c >= 0x20 && c < 0x7F));
  REQUIRE(bem::printable("a\x1b\xC3\xA9\xC3") == "a\\x1b\xC3\xA9\\xc3");
  REQUIRE(bem::printable("abcdef", 3) == "abc...");
  REQUIRE(bem::printable("ab\xC3\xA9", 3) == "ab\xC3\xA9");
}

TEST_CASE("a key twice in one object is refused at the second one") {
  REQUIRE(parse_error("{\"a\": {\"x\": 1},\n \"b\": [{\"x\": 1, \"y\": 2,\n  \"x\": 1}]}") ==
          "f.json:3:3: /b/0/x: the key \"x\" appears twice in one object");
  REQUIRE(parse_error("{\"a\": {\"a\": 1}, \"b\": {\"a\": 1}}") == "");
}

TEST_CASE("numbers beyond the range of double are refused at their place") {
  REQUIRE(parse_error("{\"a\": [0,\n 1e400]}") ==
          "f.json:2:2: /a/1: expected a number within +-1.8e308, found a larger one");
  REQUIRE(parse_error("{\"a\": -1e999}") ==
          "f.json:1:7: /a: expected a number within +-1.8e308, found a larger one");
  REQUIRE(parse_error("[1e308, 1e-400, " + std::string(300, '9') + "]") == "");
}

TEST_CASE("deep nesting is refused, at any depth, without using the stack") {
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '[') + std::string(depth, ']');
  };
  REQUIRE(parse_error(nested(JsonDocument::kMaxDepth)) == "");
  for (std::size_t depth : {std::size_t{JsonDocument::kMaxDepth} + 1, std::size_t{1000000}})
    REQUIRE_THAT(parse_error(nested(depth)),
                 Catch::StartsWith("f.json:1:101: /0/0/") &&
                     Catch::EndsWith("arrays and objects are nested more than 100 deep"));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
  REQUIRE_THAT(parse_error(objects), Catch::EndsWith("nested more than 100 deep"));
}

TEST_CASE("the time to parse grows with the size of the text only") {
  // One line, many members and many elements: quadratic work would take hours here.
  std::string text = "{\"list\": [0";
  for (int i = 1; i < 200000; ++i) text += "," + std::to_string(i);
  text += "]";
  for (int i = 0; i < 100000; ++i) text += ",\"key" + std::to_string(i) + "\":{}";
  text += "}";
  const auto start = std::chrono::steady_clock::now();
  const JsonDocument d = JsonDocument::parse("f", text);
  REQUIRE(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
  const auto last = d.find("/key99999");
  REQUIRE(last.has_value());
  REQUIRE(d.location(*last).column == static_cast<int>(text.size()) - 2);
}

TEST_CASE("files that cannot be read are errors that name them") {
  const auto folder = std::filesystem::temp_directory_path();
  REQUIRE_THAT(message_of([&] { JsonDocument::read((folder / "no-such.json").string()); }),
               Catch::EndsWith("no-such.json: cannot be opened: No such file or directory"));
  REQUIRE_THAT(message_of([&] { JsonDocument::read(folder.string()); }),
               Catch::EndsWith("cannot be read (a folder?)"));
}
