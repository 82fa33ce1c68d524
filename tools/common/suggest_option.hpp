#pragma once

#include <string>

namespace CLI {
class App;
}

namespace bem {

/// What to add to the message about an unknown option: "; did you mean --threads?", or a hint at
/// --help if no option is similar.
std::string suggest_option(const CLI::App& app, const std::string& typed);

}  // namespace bem
