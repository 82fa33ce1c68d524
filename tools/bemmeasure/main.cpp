/// bemmeasure: measures a trajectory of bemsim, or compares two.

#include "base/error.hpp"
#include "base/text.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "difference.hpp"
#include "measure.hpp"
#include "scene/scene_json.hpp"

#include <iostream>

#include <CLI/CLI.hpp>

namespace {

struct Options {
  std::string scene, trajectory;
  bem::MeasureOptions measure;
  std::vector<std::string> compared;  // two trajectories
  bem::DifferenceOptions difference;
};

/// What the command line says; false if it was for help or the version.
bool parse(int argc, char** argv, Options& o) {
  CLI::App app(
      "Penetration, rest places, speeds and energy of a trajectory, as JSON on stdout; or the "
      "differences of two trajectories. Penetration is that of vertices: bodies whose surfaces "
      "cross without a vertex in each other have none.",
      "bemmeasure");
  bem::set_up_help(app,
                   "  bemmeasure SCENE.json TRAJECTORY.h5 [options]\n"
                   "  bemmeasure --diff A.h5 B.h5 [--abs X] [--rel X] [--fields NAME ...]");
  auto* scene = app.add_option("SCENE", o.scene, "scene JSON")->type_name("");
  auto* trajectory =
      app.add_option("TRAJECTORY", o.trajectory, "what bemsim made of it")->type_name("");
  auto* self =
      app.add_flag("--self", o.measure.self, "also how deep bodies are in themselves (slow)");
  auto* series =
      app.add_option("--series", o.measure.series, "CSV file with a line per frame and body")
          ->type_name("FILE");
  auto* contacts =
      app.add_option("--contacts", o.measure.contacts,
                     "CSV file with a line per contact of all frames (of trajectories with the "
                     "field contacts)")
          ->type_name("FILE");
  auto* diff = app.add_option("--diff", o.compared,
                              "compare two trajectories: exit code 0 if all differences are "
                              "allowed, 1 if not")
                   ->expected(2)
                   ->type_name("A B")
                   ->excludes(scene)
                   ->excludes(trajectory)
                   ->excludes(self)
                   ->excludes(series)
                   ->excludes(contacts);
  const auto add = [&](const char* name, double& value, const char* text) {
    app.add_option(name, value, text)->needs(diff)->check(CLI::NonNegativeNumber);
  };
  add("--abs", o.difference.absolute, "difference that is allowed, in the unit of the field");
  add("--rel", o.difference.relative,
      "the same as a part of the largest number of the field and body in A");
  o.difference.fields = {"positions"};
  app.add_option("--fields", o.difference.fields,
                 "what is compared: names in the file (velocities, series/momentum)")
      ->needs(diff)
      ->capture_default_str();
  if (!bem::parse_command_line(app, argc, argv, "one scene and one trajectory are enough"))
    return false;
  if (o.compared.empty() && o.trajectory.empty())
    throw bem::Error(bem::ErrorCode::usage,
                     "name a scene and a trajectory, or two trajectories with --diff");
  return true;
}

int compare(const Options& o) {
  bool equal = true;
  for (const bem::FieldDifference& d :
       bem::compare_trajectories(o.compared[0], o.compared[1], o.difference)) {
    std::cout << (d.is_equal() ? "equal    " : "different") << "  " << d.body << " " << d.field
              << ": " << bem::rounded_text(d.largest, 3) << " at most, allowed "
              << bem::rounded_text(d.allowed, 3);
    if (d.largest > 0) std::cout << " (frame " << d.frame << ", vertex " << d.vertex << ")";
    std::cout << "\n";
    equal = equal && d.is_equal();
  }
  std::cout << std::flush;
  return equal ? 0 : 1;
}

int measure(const Options& o) {
  const bem::Scene scene = bem::read_scene(o.scene);
  bem::FileRoles files;
  files.reads(o.scene);
  files.reads(o.trajectory);
  for (const bem::BodySpec& body : scene.bodies) {
    files.reads(body.archive.resolved);
    if (body.render_mesh) files.reads(body.render_mesh->resolved);
  }
  for (const bem::ObstacleSpec& obstacle : scene.obstacles)
    if (const auto* mesh = std::get_if<bem::MeshObstacle>(&obstacle.shape))
      files.reads(mesh->mesh.resolved);
  files.writes(o.measure.series);
  files.writes(o.measure.contacts);
  files.check();
  const bem::Trajectory trajectory(o.trajectory, scene);
  std::cout << bem::measure(scene, trajectory, o.measure).dump(2) << "\n" << std::flush;
  return 0;
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return 0;
  return options.compared.empty() ? measure(options) : compare(options);
}

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return run(argc, argv); });
}
