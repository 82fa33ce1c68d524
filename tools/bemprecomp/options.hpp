#pragma once

#include "settings/precompute_settings.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// The command line of bemprecomp, checked.
struct Options {
  enum class Action { precompute, info, verify, diff };
  Action action = Action::precompute;
  std::vector<std::string> archives;  ///< of --info, --verify and --diff
  bool json = false;                  ///< --info as JSON

  std::string mesh, material, output;
  PrecomputeSettings settings;
  double mesh_scale = 1;
  std::optional<int> threads;

  bool dry_run = false, force = false, if_changed = false, quiet = false, verbose = false;
  std::string stats, log_file;
};

/// Parses and checks a command line; an empty result means that help or version was printed. Throws
/// ErrorCode::usage.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace bem
