/// bemsim: simulates a scene of bodies with matrix archives.

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/parallel.hpp"
#include "cache.hpp"
#include "common/cli.hpp"
#include "common/file_roles.hpp"
#include "convergence.hpp"
#include "options.hpp"
#include "plan.hpp"
#include "run.hpp"
#include "scene/scene_json.hpp"
#include "scene/schema.hpp"

#include <iostream>

namespace {

using bem::Options;

/// Checks that no output destroys an input, of which the scene may name some.
void check_files(const Options& options, const bem::Scene* scene) {
  bem::FileRoles files;
  files.reads(options.scene);
  if (scene) {
    for (const std::string& file : scene->files) files.reads(file);
    for (const bem::BodySpec& body : scene->bodies) {
      files.reads(body.archive.resolved);
      if (body.source) files.reads(body.source->mesh.resolved);
      if (body.source) files.reads(body.source->material_path.resolved);
      if (body.render_mesh) files.reads(body.render_mesh->resolved);
    }
    if (scene->initial_state) files.reads(scene->initial_state->file.resolved);
    for (const bem::ObstacleSpec& obstacle : scene->obstacles)
      if (const auto* mesh = std::get_if<bem::MeshObstacle>(&obstacle.shape))
        files.reads(mesh->mesh.resolved);
  }
  files.writes(options.stats);
  files.writes(options.log_file);
  if (options.action == Options::Action::simulate) files.writes_below(options.output);
  if (options.action == Options::Action::convergence)
    for (const std::string& file : bem::convergence_files(options)) files.writes(file);
  files.check();
}

/// Reads the scene and opens the log file. While the scene is unknown any file may be an input:
/// then only a log replaces a file that is there.
bem::Scene read_inputs(const Options& options, bem::Log& log) {
  check_files(options, nullptr);
  bem::Scene scene;
  try {
    scene = bem::read_scene(options.scene);
  } catch (const bem::Error&) {
    if (bem::Log::is_log(options.log_file)) log.open_file(options.log_file);
    throw;
  }
  check_files(options, &scene);
  if (!options.log_file.empty()) log.open_file(options.log_file);
  return scene;
}

int run_scene(const Options& options, bem::Log& log) {
  bem::Scene scene = read_inputs(options, log);
  if (options.action == Options::Action::convergence)
    return bem::run_convergence(options, scene, std::cout, log);
  bem::ProgressBar bar(log);
  const auto progress = [&](const std::string& phase, double fraction) {
    bem::check_interrupt();
    bar.update(phase, fraction);
  };
  bem::ArchiveSource source(progress);
  const std::size_t missing = bem::prepare_archives(options, scene, source, progress, log);
  bar.finish();
  if (missing > 0 || options.action == Options::Action::prepare) return 0;
  const auto plan = bem::make_plan(options, std::move(scene), source);
  for (const std::string& warning : plan->warnings) log.warning(warning);
  if (options.action == Options::Action::check)
    bem::print_plan(std::cout, *plan);
  else
    for (const std::string& note : plan->notes) log.info(note);
  bem::check_memory(*plan);
  if (options.action == Options::Action::check) return 0;
  return bem::run_simulation(*plan, source, options, log);
}

int run(int argc, char** argv, bem::Log& log) {
  const auto options = bem::parse_options(argc, argv);
  if (!options) return 0;
  if (options->quiet) log.set_verbosity(bem::Verbosity::quiet);
  if (options->verbose) log.set_verbosity(bem::Verbosity::verbose);
  if (options->threads) bem::set_thread_count(*options->threads);
  bem::catch_interrupts();
  bem::set_interruption_check(bem::check_interrupt);
  switch (options->action) {
    case Options::Action::print_schema:
      std::cout << bem::scene_schema() << std::flush;
      return 0;
    case Options::Action::cache_info:
      return bem::print_cache(std::cout, *options);
    case Options::Action::cache_clean:
      return bem::clean_cache(std::cout, *options);
    default:
      return run_scene(*options, log);
  }
}

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return run(argc, argv, log); });
}
