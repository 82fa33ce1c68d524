#pragma once

#include "base/choices.hpp"
#include "base/types.hpp"
#include "scene/json_document.hpp"
#include "scene/units.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bem {

/// One value of a JsonDocument, read with the type and range that are expected of it. Everything
/// else is an ErrorCode::invalid_input that names the place, what was expected and what was found.
/// The document must outlive its values.
class JsonValue {
 public:
  JsonValue(const JsonDocument& document, std::uint32_t id) : document_(&document), id_(id) {}

  JsonKind kind() const { return node().kind; }
  Location location() const { return document_->location(id_); }

  bool boolean() const;
  int integer_in(int low, int high) const;  ///< low <= n <= high; 3.0 is an integer
  std::string text() const;

  // Quantities, in SI units: a number, or a string with a unit of the dimension. They are finite.
  double number(const Dimension& dimension = dimension::none) const;
  double positive(const Dimension& dimension = dimension::none) const;      ///< > 0
  double non_negative(const Dimension& dimension = dimension::none) const;  ///< >= 0
  double number_in(double low, double high) const;  ///< low <= x <= high, without dimension
  double angle() const;                             ///< [rad]; a number is in degrees
  double angle_in(double low, double high) const;   ///< [rad]; the limits are in degrees
  Vec3 vec3(const Dimension& dimension = dimension::none) const;  ///< array of three quantities
  Vec3 direction() const;  ///< vec3() that is not zero, at unit length

  /// The elements of an array with at least `min_count` of them. `what` describes the array in
  /// messages: "array of bodies".
  std::vector<JsonValue> items(std::size_t min_count, const std::string& what) const;

  /// The members of an object, whatever their keys are. `what` as in JsonReader.
  std::vector<std::pair<std::string, JsonValue>> members(const std::string& what) const;

  /// Index in `names` of the string found here; a misspelt one is answered with the nearest.
  std::size_t choice(const std::vector<std::string>& names) const;
  /// The value of the enumeration T that the string found here names (base/choices.hpp).
  template <class T>
  T choice() const {
    return Choices<T>::all[choice(choice_names<T>())].value;
  }
  /// An array of such strings, at least one and each at most once. `what` as in items().
  template <class T>
  std::vector<T> choices(const std::string& what) const {
    std::vector<T> chosen;
    for (std::size_t index : choices(choice_names<T>(), what))
      chosen.push_back(Choices<T>::all[index].value);
    return chosen;
  }
  /// Indices in `names` of such strings.
  std::vector<std::size_t> choices(const std::vector<std::string>& names,
                                   const std::string& what) const;

  /// The error "expected `expected`, found ..." at this place.
  Error unexpected(const std::string& expected) const;

  /// The error `text` at this place.
  Error error(const std::string& text) const { return error_at(location(), text); }

 private:
  friend class JsonReader;
  const JsonDocument::Node& node() const { return document_->node(id_); }
  std::string found() const;
  /// Throws for anything but a number and a string with a unit of the dimension; `range` is what
  /// more is expected (" > 0"). `number_unit` is that of a number.
  double quantity(const Dimension& dimension, const std::string& range,
                  double number_unit = 1) const;

  const JsonDocument* document_;
  std::uint32_t id_;
};

/// Reads the members of one JSON object. It remembers which keys were asked for; finish() refuses
/// the members that nobody asked for.
class JsonReader {
 public:
  /// Throws unless `object` is an object; `what` describes it in messages: "a body".
  JsonReader(const JsonValue& object, const std::string& what);

  /// The member `key`. Throws if there is none; a misspelt one is named.
  JsonValue required(const std::string& key);

  /// The member `key`, if there is one.
  std::optional<JsonValue> optional(const std::string& key);

  /// Throws if none of `keys` is there.
  void require_any_of(const std::vector<std::string>& keys);

  /// The one of `keys` that is there. Throws if none is there, or more than one.
  std::string required_one_of(const std::vector<std::string>& keys);

  /// Throws the error `"key" reason` if there is such a member.
  void refuse(const std::string& key, const std::string& reason) const;

  /// Throws for the first member whose key was never asked for, with the nearest one that was.
  void finish() const;

  Location location() const { return object_.location(); }

 private:
  std::optional<std::uint32_t> child(const std::string& key) const;
  Error unknown_key(std::uint32_t id, const std::string& nearest, const std::string& more) const;
  bool is_known(const std::string& key) const;
  void refuse_misspelt(const std::string& key) const;

  JsonValue object_;
  std::vector<std::string> known_;
};

}  // namespace bem
