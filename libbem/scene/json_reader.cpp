#include "scene/json_reader.hpp"

#include "base/nearest_name.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace bem {
namespace {

constexpr double kDegree = kPi / 180;  // [rad]

std::string format(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  return std::string(digits, end);
}

std::string join(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

}  // namespace

std::string JsonValue::found() const {
  const JsonDocument::Node& n = node();
  const std::string count = std::to_string(n.count);
  switch (n.kind) {
    case JsonKind::null:
      return "null";
    case JsonKind::boolean:
      return n.boolean ? "true" : "false";
    case JsonKind::number:
      return "the number " + format(n.number);
    case JsonKind::string:
      return "the string " + in_quotes(document_->string(n.text));
    case JsonKind::array:
      return n.count == 0 ? "an empty array" : "an array of length " + count;
    case JsonKind::object:
      return "an object";
  }
  return "";
}

Error JsonValue::unexpected(const std::string& expected) const {
  return error("expected " + expected + ", found " + found());
}

bool JsonValue::boolean() const {
  if (kind() != JsonKind::boolean) throw unexpected("true or false");
  return node().boolean;
}

double JsonValue::quantity(const Dimension& dimension, const std::string& range,
                           double number_unit) const {
  if (kind() == JsonKind::number) return node().number * number_unit;
  const std::string expected = dimension_name(dimension) + range;
  if (kind() != JsonKind::string) throw unexpected(expected);
  const std::optional<Quantity> read = at_place(location(), [&] { return parse_quantity(text()); });
  if (!read)
    throw unexpected(expected +
                     (dimension == dimension::none ? "" : " (" + dimension_help(dimension) + ")"));
  if (!(read->dimension == dimension))
    throw error("expected " + expected + ", found " + dimension_name(read->dimension) + ", " +
                in_quotes(text()));
  return read->value;
}

double JsonValue::number(const Dimension& dimension) const {
  return quantity(dimension, "");
}

double JsonValue::positive(const Dimension& dimension) const {
  const double x = quantity(dimension, " > 0");
  if (!(x > 0)) throw unexpected(dimension_name(dimension) + " > 0");
  return x;
}

double JsonValue::non_negative(const Dimension& dimension) const {
  const double x = quantity(dimension, " >= 0");
  if (!(x >= 0)) throw unexpected(dimension_name(dimension) + " >= 0");
  return x;
}

double JsonValue::number_in(double low, double high) const {
  const std::string range = " from " + format(low) + " to " + format(high);
  const double x = quantity(dimension::none, range);
  if (!(low <= x && x <= high)) throw unexpected("a number" + range);
  return x;
}

double JsonValue::angle() const {
  return quantity(dimension::angle, "", kDegree);
}

double JsonValue::angle_in(double low, double high) const {
  const std::string range = " from " + format(low) + " to " + format(high) + " degrees";
  const double x = quantity(dimension::angle, range, kDegree);
  if (!(low * kDegree <= x && x <= high * kDegree)) throw unexpected("an angle" + range);
  return x;
}

int JsonValue::integer_in(int low, int high) const {
  const double x = node().number;
  if (kind() != JsonKind::number || !(low <= x && x <= high) || std::floor(x) != x)
    throw unexpected("an integer from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(x);
}

std::string JsonValue::text() const {
  if (kind() != JsonKind::string) throw unexpected("a string");
  return document_->string(node().text);
}

Vec3 JsonValue::vec3(const Dimension& dimension) const {
  if (kind() != JsonKind::array || node().count != 3) throw unexpected("an array of three numbers");
  Vec3 v;
  std::uint32_t child = node().first_child;
  for (int k = 0; k < 3; ++k) {
    v[k] = JsonValue(*document_, child).number(dimension);
    child = document_->node(child).next_sibling;
  }
  return v;
}

Vec3 JsonValue::direction() const {
  const Vec3 v = vec3();
  const double largest = v.cwiseAbs().maxCoeff();
  if (largest == 0) throw error("expected a direction, found the zero vector");
  const Vec3 scaled = v / largest;  // neither overflow nor underflow in the norm
  return scaled.normalized();
}

std::vector<JsonValue> JsonValue::items(std::size_t min_count, const std::string& what) const {
  if (kind() != JsonKind::array) throw unexpected("an " + what);
  if (node().count < min_count)
    throw unexpected("an " + what + " with at least " + std::to_string(min_count) + " element" +
                     (min_count == 1 ? "" : "s"));
  std::vector<JsonValue> out;
  out.reserve(node().count);
  for (auto child = node().first_child; child != JsonDocument::kNone;
       child = document_->node(child).next_sibling)
    out.emplace_back(*document_, child);
  return out;
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members(const std::string& what) const {
  if (kind() != JsonKind::object) throw unexpected(what + " (an object)");
  std::vector<std::pair<std::string, JsonValue>> out;
  for (std::uint32_t id : document_->children(id_))
    out.emplace_back(document_->string(document_->node(id).key), JsonValue(*document_, id));
  return out;
}

std::size_t JsonValue::choice(const std::vector<std::string>& names) const {
  const std::string expected = "one of the strings " + join(names);
  if (kind() != JsonKind::string) throw unexpected(expected);
  const std::string& word = document_->string(node().text);
  const auto match = std::find(names.begin(), names.end(), word);
  if (match != names.end()) return static_cast<std::size_t>(match - names.begin());
  const std::string nearest = nearest_name(word, names);
  throw error("expected " + expected + ", found " + in_quotes(word) +
              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

std::vector<std::size_t> JsonValue::choices(const std::vector<std::string>& names,
                                            const std::string& what) const {
  std::vector<std::size_t> chosen;
  for (const JsonValue& item : items(1, what)) {
    chosen.push_back(item.choice(names));
    if (std::count(chosen.begin(), chosen.end(), chosen.back()) > 1)
      throw item.error("the string " + in_quotes(item.text()) + " is already in this array");
  }
  return chosen;
}

JsonReader::JsonReader(const JsonValue& object, const std::string& what) : object_(object) {
  if (object.kind() != JsonKind::object) throw object.unexpected(what + " (an object)");
}

std::optional<std::uint32_t> JsonReader::child(const std::string& key) const {
  const JsonDocument& document = *object_.document_;
  for (auto id = object_.node().first_child; id != JsonDocument::kNone;
       id = document.node(id).next_sibling)
    if (document.string(document.node(id).key) == key) return id;
  return std::nullopt;
}

bool JsonReader::is_known(const std::string& key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

std::optional<JsonValue> JsonReader::optional(const std::string& key) {
  if (!is_known(key)) known_.push_back(key);
  if (const auto id = child(key)) return JsonValue(*object_.document_, *id);
  return std::nullopt;
}

void JsonReader::refuse_misspelt(const std::string& key) const {
  const JsonDocument& document = *object_.document_;
  for (auto id = object_.node().first_child; id != JsonDocument::kNone;
       id = document.node(id).next_sibling) {
    const std::string& other = document.string(document.node(id).key);
    if (!is_known(other) && !nearest_name(other, {key}).empty()) throw unknown_key(id, key, "");
  }
}

JsonValue JsonReader::required(const std::string& key) {
  if (const auto value = optional(key)) return *value;
  refuse_misspelt(key);
  throw object_.error("the required key \"" + key + "\" is missing");
}

void JsonReader::require_any_of(const std::vector<std::string>& keys) {
  known_.insert(known_.end(), keys.begin(), keys.end());
  if (std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return child(key); })) return;
  for (const std::string& key : keys) refuse_misspelt(key);
  throw object_.error("one of the keys " + join(keys) + " is required");
}

std::string JsonReader::required_one_of(const std::vector<std::string>& keys) {
  require_any_of(keys);
  std::string given;
  for (const std::string& key : keys) {
    if (!child(key)) continue;
    if (!given.empty()) refuse(key, "is not allowed beside \"" + given + "\"");
    given = key;
  }
  return given;
}

void JsonReader::refuse(const std::string& key, const std::string& reason) const {
  if (const auto id = child(key))
    throw error_at(object_.document_->key_location(*id), '"' + key + "\" " + reason);
}

Error JsonReader::unknown_key(std::uint32_t id, const std::string& nearest,
                              const std::string& more) const {
  const std::string cure = nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
  return error_at(object_.document_->key_location(id), "unknown key" + cure + more);
}

void JsonReader::finish() const {
  const JsonDocument& document = *object_.document_;
  for (auto id = object_.node().first_child; id != JsonDocument::kNone;
       id = document.node(id).next_sibling) {
    const std::string& key = document.string(document.node(id).key);
    if (!is_known(key))
      throw unknown_key(id, nearest_name(key, known_), " (allowed: " + join(known_) + ")");
  }
}

}  // namespace bem
