#include "options.hpp"

#include "base/error.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "mesh/describe.hpp"
#include "scene/named_materials.hpp"

#include <cmath>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Error(ErrorCode::usage, text);
}

/// What was typed, before it is checked.
struct Typed {
  Options options;
  std::string info, verify;
  std::vector<std::string> diff;
};

/// Every setting is an option of its name.
void add_settings(CLI::App& app, Options& o) {
  app.option_defaults()->group("Matrices");
  for (const Setting& setting : precompute_settings()) {
    const std::string option = setting_name(SettingStyle::option, setting.name);
    if (setting.kind == Setting::Kind::flag)
      app.add_flag_callback(
          option, [&o, &setting, option] { setting.set(o.settings, option, "true"); },
          setting.help);
    else
      app.add_option_function<std::string>(
             option,
             [&o, &setting, option](const std::string& text) {
               setting.set(o.settings, option, text);
             },
             setting.help)
          ->type_name(setting.type);
  }
  app.add_option("--mesh-scale", o.mesh_scale, "factor on the coordinates of the mesh (1)")
      ->type_name("F");
}

void add_options(CLI::App& app, Typed& t) {
  Options& o = t.options;
  app.add_option("MESH", o.mesh, "closed triangle mesh in any format that assimp reads")
      ->type_name("");
  app.add_option("MATERIAL", o.material, "material JSON, or the name of a material")->type_name("");
  add_settings(app, o);
  app.option_defaults()->group("Run");
  app.add_option("-o,--output", o.output, "archive to write")->type_name("BODY.bem");
  app.add_flag("--force", o.force, "overwrite an existing archive");
  app.add_flag("--if-changed", o.if_changed,
               "overwrite an existing archive only if it was made from other inputs");
  app.add_option("--threads", o.threads, "worker threads (all cores)")->type_name("N");
  app.add_flag("--dry-run", o.dry_run, "print memory, time and archive size expected, then stop");
  app.add_option("--stats", o.stats, "JSON file for time and memory by phase, sizes and errors")
      ->type_name("FILE");
  app.add_flag("-q,--quiet", o.quiet, "only warnings and errors");
  app.add_flag("-v,--verbose", o.verbose, "also details");
  app.add_option("--log-file", o.log_file, "file for all messages")->type_name("FILE");
  app.option_defaults()->group("Archives");
  app.add_option("--info", t.info, "print what is in an archive")->type_name("A.bem");
  app.add_flag("--json", o.json, "with --info: as JSON");
  app.add_option("--verify", t.verify, "check an archive: exit code 0 or 4")->type_name("A.bem");
  app.add_option("--diff", t.diff, "compare two archives: exit code 0 (equal) or 1")
      ->expected(2)
      ->type_name("A.bem");
}

void check_inputs(const Options& o) {
  if (o.mesh.empty() || o.material.empty())
    refuse("give a mesh and a material: bemprecomp MESH MATERIAL -o BODY.bem");
  if (o.output.empty() && !o.dry_run) refuse("name the archive to write: -o BODY.bem");
  if (!(std::isfinite(o.mesh_scale) && o.mesh_scale > 0))
    refuse("--mesh-scale must be a positive number, not " + to_text(o.mesh_scale));
  if (o.force && o.if_changed) refuse("use either --force or --if-changed");
  check_settings(o.settings, SettingStyle::option);
}

void check_distinct_files(const Options& o) {
  FileRoles files;
  for (const std::string& path : o.archives) files.reads(path);
  files.reads(o.mesh);
  if (!is_named_material(o.material)) files.reads(o.material);
  if (o.settings.has_load_file()) files.reads(o.settings.loads);
  for (const std::string& path : {o.output, o.stats, o.log_file}) files.writes(path);
  files.check();
}

Options checked(const CLI::App& app, Typed& t) {
  Options& o = t.options;
  const auto given = [&app](const char* name) { return app.count(name) > 0 ? 1 : 0; };
  const int actions = given("--info") + given("--verify") + given("--diff");
  if (actions > 1) refuse("use only one of --info, --verify and --diff");
  if (actions == 1 && !(o.mesh.empty() && o.output.empty()))
    refuse("--info, --verify and --diff do not compute anything: leave mesh and output away");
  if (o.json && app.count("--info") == 0) refuse("--json belongs to --info");
  if (o.quiet && o.verbose) refuse("use either --quiet or --verbose");
  if (o.threads && !(*o.threads >= 1 && *o.threads <= 4096))
    refuse("--threads must be from 1 to 4096, not " + std::to_string(*o.threads));
  if (app.count("--info") > 0) {
    o.action = Options::Action::info;
    o.archives = {t.info};
  } else if (app.count("--verify") > 0) {
    o.action = Options::Action::verify;
    o.archives = {t.verify};
  } else if (app.count("--diff") > 0) {
    o.action = Options::Action::diff;
    o.archives = t.diff;
  } else {
    check_inputs(o);
  }
  check_distinct_files(o);
  return o;
}

}  // namespace

std::optional<Options> parse_options(int argc, const char* const* argv) {
  Typed typed;
  CLI::App app("Computes the matrices of an elastic body from its surface mesh and material.",
               "bemprecomp");
  set_up_help(app,
              "  bemprecomp MESH MATERIAL -o BODY.bem [options]\n"
              "  bemprecomp --info A.bem [--json] | --verify A.bem | --diff A.bem B.bem\n");
  add_options(app, typed);
  if (!parse_command_line(app, argc, argv, "one mesh and one material are enough"))
    return std::nullopt;
  return checked(app, typed);
}

}  // namespace bem
