#include "mini_schema.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <stdexcept>

namespace bem::test {
namespace {

using Json = nlohmann::json;

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer")
    return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
  throw std::runtime_error("schema type " + type);
}

/// Whether the value has the type, or one of the types.
bool has_a_type(const Json& value, const Json& types) {
  if (types.is_string()) return has_type(value, types);
  return std::any_of(types.begin(), types.end(),
                     [&](const Json& type) { return has_type(value, type); });
}

bool has_twins(const Json& array) {
  for (std::size_t i = 0; i < array.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (array[i] == array[j]) return true;
  return false;
}

const std::string kNoControls = "^[^\\u0000-\\u001f\\u007f]*$";

bool matches(const std::string& text, const std::string& pattern) {
  if (pattern.find('%') != std::string::npos) {  // that of quantities
    static std::map<std::string, std::regex> compiled;
    return std::regex_search(text, compiled.try_emplace(pattern, pattern).first->second);
  }
  // std::regex has no zero character in its classes; the other patterns of the schema are few.
  const auto allowed = [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    if (pattern == "^[^\\u0000]+$") return byte != 0;
    if (pattern == kNoControls) return byte >= 0x20 && c != 0x7F;
    if (pattern == "^[^/\\u0000-\\u001f\\u007f]+$") return byte >= 0x20 && c != '/' && c != 0x7F;
    throw std::runtime_error("schema pattern " + pattern);
  };
  for (char c : text)
    if (!allowed(c)) return false;
  return !text.empty() || pattern == kNoControls;
}

/// Rules for numbers, strings and arrays; true if they hold or do not concern `value`.
bool holds(const std::string& keyword, const Json& rule, const Json& value) {
  if (keyword == "const") return value == rule;
  if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
  if (keyword == "minimum") return !value.is_number() || value >= rule;
  if (keyword == "maximum") return !value.is_number() || value <= rule;
  if (keyword == "exclusiveMinimum") return !value.is_number() || value > rule;
  if (keyword == "minLength") return !value.is_string() || value.get<std::string>().size() >= rule;
  if (keyword == "maxLength") return !value.is_string() || value.get<std::string>().size() <= rule;
  if (keyword == "pattern") return !value.is_string() || matches(value, rule);
  if (keyword == "minItems") return !value.is_array() || value.size() >= rule;
  if (keyword == "maxItems") return !value.is_array() || value.size() <= rule;
  if (keyword == "uniqueItems") return !value.is_array() || !has_twins(value);
  throw std::runtime_error("schema keyword " + keyword);
}

}  // namespace

std::string MiniSchema::check(const Json& schema, const Json& value) const {
  for (const auto& [keyword, rule] : schema.items()) {
    const std::string mistake = check_keyword(schema, keyword, value);
    if (!mistake.empty()) return mistake;
  }
  return "";
}

std::string MiniSchema::check_keyword(const Json& schema, const std::string& keyword,
                                      const Json& value) const {
  const Json& rule = schema.at(keyword);
  if (keyword == "title" || keyword == "description" || keyword == "$schema" || keyword == "$defs")
    return "";
  if (keyword == "$ref")
    return check(root_.at(Json::json_pointer(rule.get<std::string>().substr(1))), value);
  if (keyword == "type") return has_a_type(value, rule) ? "" : "type of " + value.dump();
  if (keyword == "oneOf" || keyword == "anyOf" || keyword == "not")
    return check_combination(keyword, rule, value);
  if (keyword == "items" && value.is_array())
    for (const Json& item : value)
      if (const std::string mistake = check(rule, item); !mistake.empty()) return mistake;
  if (keyword == "items") return "";
  if (keyword == "properties" || keyword == "required" || keyword == "additionalProperties" ||
      keyword == "dependentRequired")
    return value.is_object() ? check_object(schema, keyword, value) : "";
  return holds(keyword, rule, value) ? "" : keyword + " of " + value.dump();
}

std::string MiniSchema::check_object(const Json& schema, const std::string& keyword,
                                     const Json& value) const {
  const Json& rule = schema.at(keyword);
  if (keyword == "required")
    for (const Json& key : rule)
      if (!value.contains(key)) return "missing " + key.dump();
  if (keyword == "dependentRequired")
    for (const auto& [key, others] : rule.items())
      for (const Json& other : others)
        if (value.contains(key) && !value.contains(other)) return "missing " + other.dump();
  for (const auto& [key, member] : value.items()) {
    const bool known = schema.contains("properties") && schema.at("properties").contains(key);
    if (keyword == "additionalProperties" && !known) {
      if (rule == false) return "unknown " + key;
      if (const std::string mistake = check(rule, member); !mistake.empty()) return mistake;
    }
    if (keyword != "properties" || !known) continue;
    const std::string mistake = check(rule.at(key), member);
    if (!mistake.empty()) return mistake;
  }
  return "";
}

std::string MiniSchema::check_combination(const std::string& keyword, const Json& rule,
                                          const Json& value) const {
  if (keyword == "not") return check(rule, value).empty() ? "not of " + value.dump() : "";
  int valid = 0;
  for (const Json& option : rule) valid += check(option, value).empty() ? 1 : 0;
  return valid == 1 || (valid > 0 && keyword == "anyOf")
             ? ""
             : std::to_string(valid) + " options for " + value.dump();
}

/// The part of the schema that lists the properties of `value`.
const nlohmann::json& MiniSchema::resolved(const Json& schema, const Json& value) const {
  if (schema.contains("$ref"))
    return resolved(root_.at(Json::json_pointer(schema.at("$ref").get<std::string>().substr(1))),
                    value);
  const char* options = schema.contains("oneOf") ? "oneOf" : "anyOf";
  if (schema.contains("properties") || schema.contains("items") || !schema.contains(options))
    return schema;
  for (const Json& option : schema.at(options))
    if (check(option, value).empty()) return resolved(option, value);
  throw std::runtime_error("no option of the schema fits " + value.dump());
}

std::set<std::string> MiniSchema::properties_at(const Json& document,
                                                const Json::json_pointer& pointer) const {
  if (pointer.empty()) {
    std::set<std::string> names;
    for (const auto& [key, rule] : resolved(root_, document).at("properties").items())
      names.insert(key);
    return names;
  }
  std::vector<std::string> steps;
  for (Json::json_pointer p = pointer; !p.empty(); p.pop_back()) steps.push_back(p.back());
  const Json* schema = &resolved(root_, document);
  const Json* value = &document;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const bool array = value->is_array();
    value = array ? &value->at(std::stoul(*step)) : &value->at(*step);
    schema = &resolved(array                            ? schema->at("items")
                       : schema->contains("properties") ? schema->at("properties").at(*step)
                                                        : schema->at("additionalProperties"),
                       *value);
  }
  std::set<std::string> names;
  for (const auto& [key, rule] : schema->at("properties").items()) names.insert(key);
  return names;
}

}  // namespace bem::test
