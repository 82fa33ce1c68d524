#include "options.hpp"

#include "base/error.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "mesh/describe.hpp"
#include "scene/location.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Error(ErrorCode::usage, text);
}

/// What was typed, before it is checked.
struct Typed {
  Options options;
  std::vector<std::string> formats;
  bool check = false, print_schema = false, prepare = false, cache_info = false;
  std::optional<std::string> cache_clean;
  std::optional<int> checkpoint_every, coarser, finer;
  bool convergence = false;
};

void add_options(CLI::App& app, Typed& t) {
  Options& o = t.options;
  app.add_option("SCENE", o.scene, "scene JSON")->type_name("");
  app.option_defaults()->group("Output");
  app.add_option("-o,--output", o.output, "folder for the trajectories")->type_name("OUT_DIR");
  app.add_flag("--force", o.force, "replace the output of an earlier run");
  app.add_option("--format", t.formats,
                 "comma-separated list of hdf5, obj, vtp (ParaView), pc2 (Blender, Houdini), usda "
                 "(Universal Scene Description) and glb (glTF); default: the scene's, else hdf5")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LIST");
  app.add_option("--every", o.every, "write every N-th step; default: the scene's, else 1")
      ->type_name("N");
  app.add_option("--fps", o.fps,
                 "write this many frames per second of simulated time, the nearest steps")
      ->type_name("F");
  app.option_defaults()->group("Run");
  app.add_option("--steps", o.steps, "number of time steps; default: the scene's duration")
      ->type_name("N");
  app.add_option("--duration", o.duration, "simulated time [s]; default: the scene's")
      ->type_name("S");
  app.add_option("--threads", o.threads, "worker threads (all cores)")->type_name("N");
  app.add_option("--checkpoint-every", t.checkpoint_every,
                 "save the state every N steps, at the end and when interrupted, in "
                 "OUT_DIR/checkpoint.bin")
      ->type_name("N");
  app.add_flag("--resume", o.resume,
               "go on from the checkpoint in OUT_DIR, to the same bytes as without a stop");
  app.add_option("--stats", o.stats, "JSON file for time by phase, iterations, momentum, memory")
      ->type_name("FILE");
  app.add_flag("-q,--quiet", o.quiet, "only warnings and errors");
  app.add_flag("-v,--verbose", o.verbose, "also details");
  app.add_option("--log-file", o.log_file, "file for all messages")->type_name("FILE");
  app.option_defaults()->group("Archives of bodies with \"mesh\" and \"material\"");
  app.add_option("--cache", o.cache,
                 "folder for them (the environment's BEM_CACHE, else ~/.cache/bem)")
      ->type_name("DIR");
  app.add_flag("--prepare", t.prepare, "compute the missing ones, then stop");
  app.add_flag("--cache-info", t.cache_info, "list what is in the cache, then stop");
  app.add_option("--cache-clean", t.cache_clean,
                 "keep so many bytes of the cache, last used first (10GB, 500MB, 0), or what has "
                 "been used within some time (30d, 12h), then stop")
      ->type_name("SIZE|AGE");
  app.option_defaults()->group("Speed against error");
  app.add_flag(
      "--convergence", t.convergence,
      "run the scene on other meshes and with other time steps, print what errors and "
      "seconds belong together, and write convergence.json and convergence.svg in OUT_DIR");
  app.add_option(
         "--coarser", t.coarser,
         "meshes with 1/2, 1/4, ... of the nodes, and time steps 2, 4, ... times as long (2)")
      ->type_name("N");
  app.add_option("--finer", t.finer,
                 "meshes with 2, 4, ... times the nodes, and time steps of 1/2, 1/4, ... (1)")
      ->type_name("N");
  app.option_defaults()->group("Without a simulation");
  app.add_flag("--check", t.check,
               "validate the scene and its archives, print what would be done, then stop");
  app.add_flag("--print-schema", t.print_schema, "print the JSON Schema of scenes, then stop");
}

std::vector<const OutputFormat*> parse_formats(const std::vector<std::string>& names) {
  std::vector<const OutputFormat*> formats;
  for (const std::string& name : names) {
    const OutputFormat* format = find_output_format(name);
    if (!format)
      refuse("--format does not know " + in_quotes(name) + "; it takes " +
             list_text(output_format_names()));
    if (std::find(formats.begin(), formats.end(), format) != formats.end())
      refuse("--format names " + name + " twice");
    formats.push_back(format);
  }
  return formats;
}

void check_numbers(const Options& o) {
  const auto at_least = [](const char* option, auto value, auto lowest) {
    if (value && *value < lowest)
      refuse(std::string(option) + " must be at least " + std::to_string(lowest) + ", not " +
             std::to_string(*value));
  };
  at_least("--steps", o.steps, 0L);
  if (o.steps && *o.steps > std::numeric_limits<int>::max())
    refuse("--steps must be at most " + std::to_string(std::numeric_limits<int>::max()));
  at_least("--every", o.every, 1);
  at_least("--threads", o.threads, 1);
  if (o.threads && *o.threads > 4096) refuse("--threads must be at most 4096");
  if (o.duration && !(std::isfinite(*o.duration) && *o.duration >= 0))
    refuse("--duration must be a number >= 0, not " + to_text(*o.duration));
  if (o.fps && !(std::isfinite(*o.fps) && *o.fps > 0))
    refuse("--fps must be a number > 0, not " + to_text(*o.fps));
}

/// "10GB", "500 MB", "0": bytes; "30d", "12h": seconds.
CacheLimit parse_cache_limit(const std::string& text) {
  struct Unit {
    const char* name;
    double factor;
    bool time;
  };
  constexpr Unit kUnits[] = {{"B", 1, false},    {"kB", 1e3, false},  {"MB", 1e6, false},
                             {"GB", 1e9, false}, {"TB", 1e12, false}, {"s", 1, true},
                             {"min", 60, true},  {"h", 3600, true},   {"d", 86400, true},
                             {"w", 604800, true}};
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, code] = std::from_chars(text.data(), end, value);
  const std::string_view unit(rest + (rest != end && *rest == ' ' ? 1 : 0));
  for (const Unit& u : kUnits)
    if (code == std::errc() && value >= 0 && std::isfinite(value) && unit == u.name)
      return u.time ? CacheLimit{std::nullopt, value * u.factor}
                    : CacheLimit{value * u.factor, std::nullopt};
  if (code == std::errc() && value == 0 && unit.empty()) return CacheLimit{0.0, std::nullopt};
  refuse("--cache-clean takes a size with its unit (10GB, 500MB, 0) or an age (30d, 12h), not " +
         in_quotes(text));
}

/// The one thing that is to be done.
Options::Action parse_action(const Typed& t) {
  using Action = Options::Action;
  const std::pair<bool, Action> given[] = {
      {t.convergence, Action::convergence},   {t.check, Action::check},
      {t.print_schema, Action::print_schema}, {t.prepare, Action::prepare},
      {t.cache_info, Action::cache_info},     {t.cache_clean.has_value(), Action::cache_clean}};
  Action action = Action::simulate;
  for (const auto& [is_given, which] : given) {
    if (!is_given) continue;
    if (action != Action::simulate)
      refuse(
          "use only one of --check, --convergence, --prepare, --print-schema, --cache-info and "
          "--cache-clean");
    action = which;
  }
  return action;
}

/// The levels of --convergence, which writes no trajectories.
LevelRange parse_levels(const Typed& t) {
  constexpr int kMost = 5;
  LevelRange levels;
  levels.coarser = t.coarser.value_or(levels.coarser);
  levels.finer = t.finer.value_or(levels.finer);
  if (!t.convergence && (t.coarser || t.finer))
    refuse("--coarser and --finer belong to --convergence");
  for (const auto& [name, count] :
       {std::pair("--coarser", levels.coarser), std::pair("--finer", levels.finer)})
    if (count < 0 || count > kMost)
      refuse(std::string(name) + " must be from 0 to " + std::to_string(kMost) + ", not " +
             std::to_string(count));
  if (levels.coarser + levels.finer == 0) refuse("--coarser 0 --finer 0 leaves nothing to compare");
  const Options& o = t.options;
  if (t.convergence && (!t.formats.empty() || !o.stats.empty() || o.resume || t.checkpoint_every))
    refuse(
        "--convergence writes no trajectories: leave --format, --stats, --checkpoint-every and "
        "--resume away");
  return levels;
}

Options checked(Typed& t) {
  Options& o = t.options;
  if (o.resume && o.force) refuse("use either --resume or --force");
  if (o.steps && o.duration) refuse("use either --steps or --duration");
  if (o.every && o.fps) refuse("use either --every or --fps");
  if (o.quiet && o.verbose) refuse("use either --quiet or --verbose");
  o.formats = parse_formats(t.formats);
  check_numbers(o);
  if (t.checkpoint_every && *t.checkpoint_every < 1)
    refuse("--checkpoint-every must be at least 1, not " + std::to_string(*t.checkpoint_every));
  o.checkpoint_every = t.checkpoint_every.value_or(0);
  o.action = parse_action(t);
  o.levels = parse_levels(t);
  if (o.action == Options::Action::cache_clean) o.cache_limit = parse_cache_limit(*t.cache_clean);
  if (!o.needs_scene()) return o;
  if (o.scene.empty()) refuse("give a scene file: bemsim SCENE.json -o OUT_DIR");
  if (o.writes_output() && o.output.empty()) refuse("name the folder for the output: -o OUT_DIR");
  return o;
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
  Typed typed;
  CLI::App app("Simulates a scene of deformable bodies and writes their trajectories.", "bemsim");
  set_up_help(app,
              "  bemsim SCENE.json -o OUT_DIR [options]\n"
              "  bemsim SCENE.json --convergence -o OUT_DIR [--coarser N] [--finer N]\n"
              "  bemsim SCENE.json --check | --prepare\n"
              "  bemsim --cache-info | --cache-clean SIZE|AGE\n");
  add_options(app, typed);
  if (!parse_command_line(app, argc, argv, "one scene is enough")) return std::nullopt;
  return checked(typed);
}

}  // namespace bem
