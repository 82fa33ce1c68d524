#include "mini_schema.hpp"
#include "scene/schema.hpp"
#include "scene_examples.hpp"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>

using bem::test::full_scene;
using bem::test::MiniSchema;
using bem::test::scene_error;
using Json = nlohmann::json;
using Pointer = Json::json_pointer;

namespace {

MiniSchema schema() {
  return MiniSchema(Json::parse(bem::scene_schema()));
}

/// Pointers to `value` and everything in it.
void collect(const Json& value, const Pointer& pointer, std::vector<Pointer>& out) {
  out.push_back(pointer);
  if (value.is_object())
    for (const auto& [key, member] : value.items()) collect(member, pointer / key, out);
  if (value.is_array())
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], pointer / i, out);
}

std::vector<Pointer> all_pointers(const Json& document) {
  std::vector<Pointer> out;
  collect(document, Pointer(), out);
  return out;
}

/// The keys that the reader lists as allowed in an object, from its own message.
std::set<std::string> allowed_keys(const std::string& message) {
  const std::string start = "(allowed: ";
  const auto at = message.rfind(start);
  if (at == std::string::npos) return {};
  std::istringstream words(message.substr(at + start.size()));
  std::set<std::string> keys;
  for (std::string word; words >> word;) {
    word.pop_back();  // comma or bracket
    keys.insert(word);
  }
  return keys;
}

/// Whether an error of the reader is about something that a schema cannot express.
bool beyond_schema(const std::string& message) {
  // Includes and defaults may have the keys that scenes, bodies and obstacles need.
  static const std::regex missing(
      "^s.json:[0-9:]* (/(bodies|obstacles)/[0-9]+: )?(the required key|one of the keys (plane, "
      "mesh|archive, mesh))");
  if (std::regex_search(message, missing)) return true;
  for (const char* part :
       {"the zero vector", "a later time than", "\"max\" >= \"min\"", "already used at",
        "of this scene, found", "is for obstacles with a mesh", "needs a \"direction\"",
        "there is no group", "there is no material", "cannot consist of another one",
        "copies, found", " to include ", "/precompute/", "/precompute: ", "cannot be opened",
        "cannot be read", "speed of shear waves", "another body than",
        "time steps, found a duration",
        // what the unit of a string measures
        ", found a number, \"", ", found a length, \"", ", found a quantity in "})
    if (message.find(part) != std::string::npos) return true;
  return false;
}

/// Reader and schema give the same verdict on `document`.
void require_agreement(const MiniSchema& rules, const Json& document) {
  const std::string reader = scene_error(document.dump());
  const std::string mistake = rules.check(document);
  INFO("reader: " << reader << "\nschema: " << mistake << "\n" << document.dump());
  if (beyond_schema(reader))
    SUCCEED();
  else
    REQUIRE(reader.empty() == mistake.empty());
}

/// The full scene, and one whose parts have forms that the full one lacks.
std::vector<Json> examples() {
  return {Json::parse(full_scene()),
          Json::parse(bem::test::scene_with(R"(, "initial_state": {"checkpoint": "run.bin"})"))};
}

}  // namespace

TEST_CASE("the schema accepts what the reader accepts: the examples") {
  for (const Json& example : examples()) {
    REQUIRE(scene_error(example.dump()) == "");
    REQUIRE(schema().check(example) == "");
  }
}

TEST_CASE("the examples use every key of the schema but for settings of matrices") {
  std::set<std::string> used, known;
  for (const Json& example : examples())
    for (const Pointer& pointer : all_pointers(example))
      if (!pointer.empty()) used.insert(pointer.back());
  const Json rules = Json::parse(bem::scene_schema());
  for (const Pointer& pointer : all_pointers(rules))
    if (!pointer.empty() && pointer.back() == "properties" &&
        pointer.to_string().find("/precompute/") == std::string::npos)
      for (const auto& property : rules.at(pointer).items()) known.insert(property.key());
  for (const std::string& key : known) {
    INFO(key);
    CHECK(used.count(key) == 1);
  }
}

TEST_CASE("every object has the same keys in the reader and in the schema") {
  const MiniSchema rules = schema();
  const Json full = Json::parse(full_scene());
  int objects = 0;
  for (const Pointer& pointer : all_pointers(full)) {
    if (!full.at(pointer).is_object()) continue;
    Json extended = full;
    extended[pointer]["zzzzzzzzzz"] = 1;
    const std::string message = scene_error(extended.dump());
    INFO(message);
    ++objects;
    if (!pointer.empty() && pointer.back() == "groups") continue;  // whatever the names are
    REQUIRE(allowed_keys(message).size() >= full.at(pointer).size());
    std::set<std::string> keys = rules.properties_at(full, pointer);
    std::set<std::string> read = allowed_keys(message);
    // Of keys that exclude each other the reader lists all, the schema those of one form.
    const auto form_of = [&](const std::set<std::string>& forms) {
      for (const std::string& key : forms)
        if (!full.at(pointer).contains(key)) keys.erase(key), read.erase(key);
    };
    form_of({"vertices", "triangles", "box", "sphere", "plane", "group"});
    form_of({"plane", "mesh"});
    if (pointer.to_string() == "/defaults/obstacle")  // the reader's list is that of a plane
      for (const char* key : {"scale", "position", "rotation", "motion"}) keys.erase(key);
    if (!full.at(pointer).contains("normal")) {  // allowed only beside a normal
      keys.erase("normal_tolerance_deg");
      read.erase("normal_tolerance_deg");
    }
    REQUIRE(read == keys);
    REQUIRE(rules.check(extended) != "");
  }
  REQUIRE(objects == std::count(full_scene().begin(), full_scene().end(), '{'));
}

TEST_CASE("reader and schema agree on scenes with a member or element left out") {
  const MiniSchema rules = schema();
  for (const Json& example : examples())
    for (const Pointer& pointer : all_pointers(example)) {
      if (pointer.empty()) continue;
      Json changed = example;
      Json& parent = changed[pointer.parent_pointer()];
      if (parent.is_object())
        parent.erase(pointer.back());
      else
        parent.erase(std::stoul(pointer.back()));
      require_agreement(rules, changed);
    }
}

TEST_CASE("reader and schema agree on scenes with a value replaced") {
  const MiniSchema rules = schema();
  Json values = Json::parse(R"([null, true, false, -1, 0, 1, 0.5, 181, 3e9, "", "all", "a/b", "..",
      "\u0000", "point", "hdf5", "12 mm", "-3 kg/m^2", "5 %", "7", "7 mmm", [], {}, [1, 2, 3], [1, 2], ["hdf5", "hdf5"],
      {"box": {"min": [0, 0, 0], "max": [1, 1, 1]}, "normal_tolerance_deg": 3},
      {"vertices": [1], "triangles": [1]}, {"vertices": [1], "normal": [1, 0, 0]},
      {"select": "all", "pressure": 1, "follow": false},
      {"select": "all", "pressure": 1, "traction": [1, 0, 0]}])");
  values.push_back(std::string(201, 'n'));
  for (const Json& example : examples())
    for (const Pointer& pointer : all_pointers(example))
      for (const Json& value : values) {
        if (pointer.empty() && value.is_null()) continue;
        Json changed = example;
        changed[pointer] = value;
        require_agreement(rules, changed);
      }
}

TEST_CASE("every object of the schema is closed and every reference leads somewhere") {
  const Json root = Json::parse(bem::scene_schema());
  REQUIRE(root.at("$schema") == "https://json-schema.org/draft/2020-12/schema");
  int closed = 0;
  for (const Pointer& pointer : all_pointers(root)) {
    const Json& part = root.at(pointer);
    if (!part.is_object()) continue;
    if (part.contains("type") && part.at("type") == "object") {
      INFO(pointer.to_string());
      if (!pointer.empty() && pointer.back() == "groups")
        REQUIRE(part.at("additionalProperties").contains("$ref"));
      else
        REQUIRE(part.at("additionalProperties") == false);
      ++closed;
    }
    if (part.contains("$ref"))
      REQUIRE(root.contains(Pointer(part.at("$ref").get<std::string>().substr(1))));
  }
  REQUIRE(closed > 15);
}
