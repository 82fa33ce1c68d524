#pragma once

#include <string>
#include <vector>

// The text of the schema has marks where something follows from the code. Every function throws
// ErrorCode::internal if the text does not have its mark.

namespace bem {

/// Puts `text` wherever the schema has the mark.
void replace_mark(std::string& schema, const std::string& mark, const std::string& text);

/// Puts names in place of that of their kind: "enum": "T" becomes "enum": ["a", "b"].
void list_names(std::string& schema, const std::string& kind,
                const std::vector<std::string>& choices);

/// Puts a regular expression in place of its name.
void write_pattern(std::string& schema, const std::string& name, const std::string& pattern);

/// What is between the bracket at the end of `mark` and the one that closes it.
std::string members_after(const std::string& schema, const std::string& mark);

}  // namespace bem
