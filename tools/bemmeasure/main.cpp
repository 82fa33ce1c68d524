/// bemmeasure: measures a trajectory of bemsim by its positions.

#include "base/error.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "measure.hpp"
#include "scene/scene_json.hpp"

#include <iostream>

#include <CLI/CLI.hpp>

namespace {

int run(int argc, char** argv) {
  CLI::App app(
      "Penetration, rest places, speeds and energy of a trajectory, as JSON on stdout. "
      "Penetration is that of vertices: bodies whose surfaces cross without a vertex in "
      "each other have none.",
      "bemmeasure");
  bem::set_up_help(app, "  bemmeasure SCENE.json TRAJECTORY.h5 [options]");
  std::string scene_file, trajectory_file;
  bem::MeasureOptions options;
  app.add_option("SCENE", scene_file, "scene JSON")->required()->type_name("");
  app.add_option("TRAJECTORY", trajectory_file, "what bemsim made of it")
      ->required()
      ->type_name("");
  app.add_flag("--self", options.self, "also how deep bodies are in themselves (slow)");
  app.add_option("--series", options.series, "CSV file with a line per frame and body")
      ->type_name("FILE");
  if (!bem::parse_command_line(app, argc, argv, "one scene and one trajectory are enough"))
    return 0;
  const bem::Scene scene = bem::read_scene(scene_file);
  bem::FileRoles files;
  files.reads(scene_file);
  files.reads(trajectory_file);
  for (const bem::BodySpec& body : scene.bodies) {
    files.reads(body.archive.resolved);
    if (body.render_mesh) files.reads(body.render_mesh->resolved);
  }
  for (const bem::ObstacleSpec& obstacle : scene.obstacles)
    if (const auto* mesh = std::get_if<bem::MeshObstacle>(&obstacle.shape))
      files.reads(mesh->mesh.resolved);
  files.writes(options.series);
  files.check();
  const bem::Trajectory trajectory(trajectory_file, scene);
  std::cout << bem::measure(scene, trajectory, options).dump(2) << "\n" << std::flush;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return run(argc, argv); });
}
