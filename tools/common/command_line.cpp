#include "common/command_line.hpp"

#include "base/error.hpp"
#include "base/nearest_name.hpp"
#include "common/cli.hpp"
#include "scene/location.hpp"

#include <sstream>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

constexpr std::size_t kNameColumns = 26, kColumns = 100;

/// `text` with line breaks before words that would end beyond `columns`.
std::string wrapped(const std::string& text, std::size_t columns) {
  std::istringstream words(text);
  std::string out, word;
  std::size_t line = 0;
  while (words >> word) {
    const bool fits = line + 1 + word.size() <= columns;
    if (line > 0) out += fits ? ' ' : '\n';
    line = (fits && line > 0 ? line + 1 : 0) + word.size();
    out += word;
  }
  return out;
}

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::string usage) : usage_(std::move(usage)) {
    column_width(kNameColumns);
  }
  std::string make_usage(const CLI::App* /*app*/, std::string /*name*/) const override {
    return usage_;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), kColumns - kNameColumns);
  }

 private:
  std::string usage_;
};

/// "; did you mean --threads?", or a hint at --help if no option is similar.
std::string suggestion(const CLI::App& app, const std::string& typed) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string nearest = nearest_name(typed.substr(0, typed.find('=')), names);
  return nearest.empty() ? "; run with --help for the options" : "; did you mean " + nearest + "?";
}

}  // namespace

void set_up_help(CLI::App& app, const std::string& usage) {
  app.set_version_flag("--version", version_text(), "print the version");
  app.set_help_flag("-h,--help", "print this help");
  app.formatter(std::make_shared<HelpFormatter>(usage));
  app.footer(
      "Exit codes: 0 ok, 1 internal error, 2 usage, 3 invalid input, 4 archive, 5 numerical "
      "failure,\n"
      "6 memory, disk or permission, 130 and 143 interrupted");
}

std::string message_of(const CLI::App& app, const CLI::ParseError& e) {
  const std::string text = e.what();
  const std::string unconverted = "Could not convert: ";
  const std::size_t equals = text.find(" = ");
  if (text.compare(0, unconverted.size(), unconverted) == 0 && equals != std::string::npos)
    return text.substr(unconverted.size(), equals - unconverted.size()) + ": " +
           in_quotes(text.substr(equals + 3)) + " is not a number";
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option =
      dynamic_cast<const CLI::ArgumentMismatch*>(&e) ? app.get_option_no_throw(name) : nullptr;
  if (!option) return text;
  if (static_cast<int>(option->count()) > option->get_items_expected_max())
    return name + " is given more than once";
  const int values = option->get_items_expected_min();
  return name + (values == 1 ? " needs a value" : " needs " + std::to_string(values) + " values");
}

bool parse_command_line(CLI::App& app, int argc, const char* const* argv,
                        const std::string& enough) {
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::ExtrasError&) {
    const std::vector<std::string> extras = app.remaining();
    const std::string first = extras.empty() ? "" : extras.front();
    if (first.rfind('-', 0) != 0)
      throw Error(ErrorCode::usage, "unexpected argument " + in_quotes(first) + "; " + enough);
    throw Error(ErrorCode::usage, "unknown option " + printable(first) + suggestion(app, first));
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
      throw Error(ErrorCode::usage, message_of(app, e));
    app.exit(e);
    return false;
  }
}

}  // namespace bem
