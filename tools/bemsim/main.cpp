/// bemsim: simulates a scene of bodies with matrix archives.

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "options.hpp"
#include "plan.hpp"
#include "run.hpp"
#include "scene/scene_json.hpp"
#include "scene/schema.hpp"

#include <filesystem>
#include <iostream>

namespace {

using bem::Options;

/// An output must not destroy an input.
void check_distinct(const Options& options, const std::string& input) {
  std::error_code ignored;
  for (const std::string& output : {options.stats, options.log_file})
    if (!output.empty() && std::filesystem::equivalent(output, input, ignored))
      throw bem::Error(bem::ErrorCode::usage,
                       output + ": is an input and cannot be an output as well");
}

/// Reads the scene and opens the log file, which must be none of the scene's archives.
bem::Scene read_inputs(const Options& options, bem::Log& log) {
  check_distinct(options, options.scene);
  const auto open_log = [&] {
    if (!options.log_file.empty()) log.open_file(options.log_file);
  };
  bem::Scene scene;
  try {
    scene = bem::read_scene(options.scene);
  } catch (const bem::Error&) {
    open_log();
    throw;
  }
  for (const bem::BodySpec& body : scene.bodies) check_distinct(options, body.archive.resolved);
  open_log();
  return scene;
}

int run(int argc, char** argv, bem::Log& log) {
  const auto options = bem::parse_options(argc, argv);
  if (!options) return 0;
  if (options->action == Options::Action::print_schema) {
    std::cout << bem::scene_schema() << std::flush;
    return 0;
  }
  if (options->quiet) log.set_verbosity(bem::Verbosity::quiet);
  if (options->verbose) log.set_verbosity(bem::Verbosity::verbose);
  if (options->threads) bem::set_thread_count(*options->threads);
  bem::catch_interrupts();
  bem::set_interruption_check(bem::check_interrupt);
  bem::Scene scene = read_inputs(*options, log);

  bem::ProgressBar bar(log);
  bem::ArchiveSource source([&](const std::string& phase, double fraction) {
    bem::check_interrupt();
    bar.update(phase, fraction);
  });
  const auto plan = bem::make_plan(*options, std::move(scene), source);
  for (const std::string& warning : plan->warnings) log.warning(warning);
  if (options->action == Options::Action::check)
    bem::print_plan(std::cout, *plan);
  else
    for (const std::string& note : plan->notes) log.info(note);
  bem::check_memory(*plan);
  if (options->action == Options::Action::check) return 0;
  return bem::run_simulation(*plan, source, *options, log);
}

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return run(argc, argv, log); });
}
