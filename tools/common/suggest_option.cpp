#include "common/suggest_option.hpp"

#include "base/nearest_name.hpp"

#include <CLI/CLI.hpp>

namespace bem {

std::string suggest_option(const CLI::App& app, const std::string& typed) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string nearest = nearest_name(typed.substr(0, typed.find('=')), names);
  return nearest.empty() ? "; run with --help for the options" : "; did you mean " + nearest + "?";
}

}  // namespace bem
