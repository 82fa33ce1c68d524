#pragma once

#include "common/log.hpp"
#include "repair/repair_options.hpp"

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bem {

/// `bemshape repair|remesh|wrap IN -o OUT`.
struct MendOptions {
  std::string input;
  std::string output;
  std::string fill_holes = "small";
  std::optional<int> nodes;  ///< else as many as result
  RepairOptions repair;
};

/// Adds the subcommands; when one is given, `action` becomes what it does.
void add_mend_commands(CLI::App& app, MendOptions& options, std::function<void()>& action,
                       Log& log);

}  // namespace bem
