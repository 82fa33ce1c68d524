#pragma once

#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// The command line of bemsim, checked.
struct Options {
  enum class Action { simulate, check, print_schema };
  Action action = Action::simulate;

  std::string scene, output;
  std::vector<const OutputFormat*> formats;  ///< empty: the scene's
  std::optional<long> steps;
  std::optional<double> duration;  ///< [s]
  std::optional<int> every;        ///< steps from frame to frame
  std::optional<double> fps;       ///< frames per second of simulated time
  std::optional<int> threads;
  int checkpoint_every = 0;  ///< steps; 0: no checkpoints
  bool resume = false;
  bool force = false, quiet = false, verbose = false;
  std::string stats, log_file;
};

/// Parses and checks a command line; an empty result means that help or version was printed. Throws
/// ErrorCode::usage.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace bem
