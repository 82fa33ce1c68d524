#include "scene/schema.hpp"

#include "base/error.hpp"
#include "scene/scene.hpp"
#include "scene/schema_marks.hpp"
#include "scene/schema_text.hpp"
#include "scene/units.hpp"

namespace bem {
namespace {

/// The defaults of bodies and obstacles have their members.
void write_defaults(std::string& schema) {
  const std::string properties = "\"properties\": {";
  const auto all_after = [&](const std::string& mark) {
    const std::size_t at = schema.find(mark);
    require(at != std::string::npos, "the schema has every mark");
    return members_after(schema.substr(at), properties);
  };
  const std::string body = all_after("    \"body\": {\n      \"type\"");
  const std::string obstacle =
      "\"plane\": {\"$ref\": \"#/$defs/plane\"}," +
      all_after(properties +
                "\n            \"name\": {\"$ref\": \"#/$defs/name\"},\n            \"mesh\"");
  replace_mark(schema, "\"properties\": \"of body\"", properties + body + "}");
  replace_mark(schema, "\"properties\": \"of obstacle\"", properties + obstacle + "}");
}

const char* rule_of(Setting::Kind kind) {
  switch (kind) {
    case Setting::Kind::number:
      return R"("$ref": "#/$defs/quantity")";
    case Setting::Kind::integer:
      return R"("type": "integer")";
    case Setting::Kind::flag:
      return R"("type": "boolean")";
    case Setting::Kind::text:
      return R"("type": ["string", "number"])";
  }
  return "";
}

/// Puts the settings in place of their mark.
void list_settings(std::string& schema) {
  std::string members;
  for (const Setting& setting : precompute_settings())
    if (setting.in_scenes)
      members += (members.empty() ? "" : ",") + std::string("\n        \"") + setting.key() +
                 "\": {\"description\": \"" + setting.help + "\", " + rule_of(setting.kind) + "}";
  replace_mark(schema, "\"settings\"", "{" + members + "\n      }");
}

std::string with_names(std::string schema) {
  write_defaults(schema);
  list_settings(schema);
  list_names(schema, "FrameMotion", choice_names<FrameMotion>());
  list_names(schema, "Correction", choice_names<Correction>());
  list_names(schema, "FrictionCombine", choice_names<FrictionCombine>());
  list_names(schema, "FrictionMethod", choice_names<FrictionMethod>());
  list_names(schema, "OutputFormat", output_format_names());
  list_names(schema, "OutputField", choice_names<OutputField>());
  list_names(schema, "OutputSurface", choice_names<OutputSurface>());
  write_pattern(schema, "quantity", quantity_pattern(false));
  write_pattern(schema, "non-negative quantity", quantity_pattern(true));
  return schema;
}

}  // namespace

const std::string& scene_schema() {
  static const std::string schema = with_names(kSchemaText);
  return schema;
}

}  // namespace bem
