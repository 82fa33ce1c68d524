#pragma once

#include <set>
#include <string>

#include <nlohmann/json.hpp>

namespace bem::test {

/// Checks JSON values against the part of JSON Schema that the project's schema uses. An unknown
/// keyword of the schema throws std::runtime_error, so that no rule is silently left out.
class MiniSchema {
 public:
  explicit MiniSchema(nlohmann::json root) : root_(std::move(root)) {}

  /// The first mistake in `value`; "" if it is valid.
  std::string check(const nlohmann::json& value) const { return check(root_, value); }

  /// Names of the properties allowed in the object at `pointer` of the valid `document`.
  std::set<std::string> properties_at(const nlohmann::json& document,
                                      const nlohmann::json::json_pointer& pointer) const;

 private:
  using Json = nlohmann::json;
  std::string check(const Json& schema, const Json& value) const;
  std::string check_keyword(const Json& schema, const std::string& keyword,
                            const Json& value) const;
  std::string check_object(const Json& schema, const std::string& keyword, const Json& value) const;
  std::string check_combination(const std::string& keyword, const Json& rule,
                                const Json& value) const;
  const Json& resolved(const Json& schema, const Json& value) const;

  Json root_;
};

}  // namespace bem::test
