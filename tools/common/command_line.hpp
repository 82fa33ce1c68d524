#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace bem {

/// Sets up what the tools' help has in common: version, the lines `usage` instead of CLI11's own,
/// and descriptions that fit 100 columns.
void set_up_help(CLI::App& app, const std::string& usage);

/// What CLI11 says of a mistake, where it can be said better; `app` has the options.
std::string message_of(const CLI::App& app, const CLI::ParseError& e);

/// Parses a command line; false means that help or version was printed. Throws ErrorCode::usage
/// with a message for people: a misspelt option is answered with the nearest, and `enough` says
/// what is expected where there is an argument too many ("one scene is enough").
bool parse_command_line(CLI::App& app, int argc, const char* const* argv,
                        const std::string& enough);

}  // namespace bem
