#pragma once

#include "convergence/study_levels.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// What --cache-clean leaves in the cache.
struct CacheLimit {
  std::optional<double> bytes;  ///< at most so many bytes,
  std::optional<double> age;    ///< or what has been used within so many seconds
};

/// The command line of bemsim, checked.
struct Options {
  enum class Action {
    simulate,
    convergence,
    prepare,
    check,
    print_schema,
    cache_info,
    cache_clean
  };
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
  std::string cache;       ///< folder of computed archives; empty: the default one
  CacheLimit cache_limit;  ///< of Action::cache_clean
  LevelRange levels;       ///< of Action::convergence

  bool needs_scene() const {
    return writes_output() || action == Action::prepare || action == Action::check;
  }
  bool writes_output() const { return action == Action::simulate || action == Action::convergence; }
};

/// Parses and checks a command line; an empty result means that help or version was printed. Throws
/// ErrorCode::usage.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace bem
