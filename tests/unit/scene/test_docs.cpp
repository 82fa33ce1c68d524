#include "scene/material_json.hpp"
#include "scene/schema.hpp"
#include "scene_examples.hpp"

#include <fstream>
#include <iterator>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace {

std::string documentation() {
  std::ifstream file(BEM_DOCS "/scene-format.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> json_blocks(const std::string& text) {
  const std::string open = "```json\n", close = "\n```";
  std::vector<std::string> blocks;
  for (auto at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const auto begin = at + open.size();
    blocks.push_back(text.substr(begin, text.find(close, begin) - begin));
  }
  return blocks;
}

void collect_keys(const nlohmann::json& schema, std::vector<std::string>& keys) {
  if (!schema.is_structured()) return;
  if (schema.is_object() && schema.contains("properties"))
    for (const auto& [key, rule] : schema.at("properties").items()) keys.push_back(key);
  for (const auto& [key, part] : schema.items()) collect_keys(part, keys);
}

}  // namespace

TEST_CASE("the examples of the documentation are valid") {
  const auto blocks = json_blocks(documentation());
  REQUIRE(blocks.size() == 4);
  REQUIRE(bem::parse_material("docs", blocks[0]).name == "silicone");
  REQUIRE(bem::parse_scene("docs", blocks[1]).bodies[0].tractions[0].profile.size() == 3);
  const bem::Scene handle =
      bem::parse_scene("docs", bem::test::scene_with_body(",\"handles\": [" + blocks[2] + "]"));
  REQUIRE(handle.bodies[0].handles[0].motion.size() == 3);
  std::string joints = bem::test::full_scene();
  const auto at = joints.find("\"joints\"");
  joints.replace(at, joints.find("\"contact\"") - at, blocks[3] + ",");
  REQUIRE(bem::parse_scene("docs", joints).joints.size() == 2);
}

TEST_CASE("the documentation names every key of the scene") {
  const std::string text = documentation();
  std::vector<std::string> keys;
  collect_keys(nlohmann::json::parse(bem::scene_schema()), keys);
  REQUIRE(keys.size() > 50);
  for (const std::string& key : keys) {
    INFO(key);
    REQUIRE((text.find('`' + key + '`') != std::string::npos ||
             text.find('"' + key + "\":") != std::string::npos));
  }
}
