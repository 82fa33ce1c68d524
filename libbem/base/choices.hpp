#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace bem {

/// A value of an enumeration with the name that files and command lines have for it.
template <class T>
struct Choice {
  T value;
  const char* name;
};

/// The values of an enumeration T and their names, in the order in which messages list them. An
/// enumeration that is read has a specialisation with a static array `all` beside its definition;
/// readers, schemas and messages take the names from there.
template <class T>
struct Choices;

template <class T>
std::vector<std::string> choice_names() {
  std::vector<std::string> names;
  for (const Choice<T>& choice : Choices<T>::all) names.emplace_back(choice.name);
  return names;
}

template <class T>
std::string choice_name(T value) {
  for (const Choice<T>& choice : Choices<T>::all)
    if (choice.value == value) return choice.name;
  return "?";
}

/// The value with this name, if there is one.
template <class T>
std::optional<T> find_choice(const std::string& name) {
  for (const Choice<T>& choice : Choices<T>::all)
    if (choice.name == name) return choice.value;
  return std::nullopt;
}

/// "a, b or c".
inline std::string list_text(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
  return out;
}

/// "a, b or c" with the names of T.
template <class T>
std::string choice_list() {
  return list_text(choice_names<T>());
}

}  // namespace bem
