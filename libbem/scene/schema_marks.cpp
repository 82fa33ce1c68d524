#include "scene/schema_marks.hpp"

#include "base/error.hpp"

namespace bem {

void replace_mark(std::string& schema, const std::string& mark, const std::string& text) {
  std::size_t at = schema.find(mark);
  require(at != std::string::npos, "the schema has every mark");
  for (; at != std::string::npos; at = schema.find(mark, at + text.size()))
    schema.replace(at, mark.size(), text);
}

void list_names(std::string& schema, const std::string& kind,
                const std::vector<std::string>& choices) {
  std::string names;
  for (const std::string& name : choices) names += (names.empty() ? "\"" : ", \"") + name + "\"";
  replace_mark(schema, "\"enum\": \"" + kind + "\"", "\"enum\": [" + names + "]");
}

void write_pattern(std::string& schema, const std::string& name, const std::string& pattern) {
  std::string escaped;
  for (char c : pattern) escaped += c == '\\' ? std::string("\\\\") : std::string(1, c);
  replace_mark(schema, "\"pattern\": \"" + name + "\"", "\"pattern\": \"" + escaped + "\"");
}

std::string members_after(const std::string& schema, const std::string& mark) {
  const std::size_t first = schema.find(mark) + mark.size();
  require(first >= mark.size(), "the schema has every mark");
  std::size_t at = first;
  for (int depth = 1; depth > 0; ++at) depth += schema[at] == '{' ? 1 : schema[at] == '}' ? -1 : 0;
  return schema.substr(first, at - 1 - first);
}

}  // namespace bem
