#include "mend.hpp"

#include "base/error.hpp"
#include "common/command_line.hpp"
#include "mesh/describe.hpp"
#include "mesh/mesh_io.hpp"
#include "output.hpp"
#include "repair/repair.hpp"
#include "repair/turn_outward.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

void check_output(const MendOptions& o) {
  check_output_name(o.output);
  std::error_code missing;
  if (std::filesystem::equivalent(o.output, o.input, missing))
    throw Error(ErrorCode::usage, "-o would overwrite the input " + o.input);
}

/// Advice for a mesh that only a repair could remesh.
RepairedMesh repaired(const MendOptions& o, const RepairOptions& options) {
  const TriangleMesh mesh = read_mesh(o.input);
  try {
    return repair_mesh(mesh, options, o.input);
  } catch (const Error& e) {
    if (options.mode != RepairMode::off || e.code() != ErrorCode::invalid_input) throw;
    throw Error(e.code(), e.what() + repair_advice(o.input));
  }
}

/// A closed surface that points inward is one that programs accept, but none that they should get.
void turn(RepairedMesh& repaired, const std::string& name) {
  const std::size_t turned = turn_outward(repaired.mesh, name);
  if (turned == 0) return;
  repaired.report.steps.push_back("turned " + count_text(turned, "triangle") + " outward");
  repaired.report.changed = true;
}

void mend(const MendOptions& o, RepairMode mode, Log& log) {
  RepairOptions options = o.repair;
  options.mode = mode;
  options.fill_all_holes = o.fill_holes == "all";
  if (o.nodes) options.nodes = o.nodes;
  check_output(o);
  RepairedMesh result = repaired(o, options);
  if (!result.report.changed) turn(result, o.input);
  write_obj(o.output, result.mesh);
  for (const std::string& step : result.report.steps) log.info(o.input + ": " + step);
  if (!result.report.changed) log.info(o.input + ": nothing to repair");
  log.info(o.output + ": " + count_text(result.mesh.vertices.size(), "vertex") + ", " +
           count_text(result.mesh.triangles.size(), "triangle"));
}

void add_wrap_options(CLI::App& command, RepairOptions& o) {
  command.add_option("--alpha", o.alpha, "gaps narrower than this part of the size are bridged");
  command.add_option("--offset", o.offset, "distance from the surface, as a part of the size");
}

void add_remesh_options(CLI::App& command, MendOptions& o, bool required) {
  CLI::Option* nodes = command.add_option("--nodes", o.nodes, "remesh to about so many vertices");
  if (required) nodes->required();
  command.add_option("--feature-angle", o.repair.feature_angle_deg,
                     "edges that are sharper stay edges when remeshed [deg]");
}

}  // namespace

void add_mend_commands(CLI::App& app, MendOptions& o, std::function<void()>& action, Log& log) {
  const auto add = [&](const std::string& name, const std::string& help, RepairMode mode) {
    CLI::App* command = app.add_subcommand(name, help);
    command->option_defaults()->always_capture_default();
    command->add_option("mesh", o.input, "mesh file to read")->required();
    command->add_option("-o,--output", o.output, "OBJ file to write (overwritten if it exists)")
        ->required();
    command->callback(
        [&o, &action, &log, mode] { action = [&o, &log, mode] { mend(o, mode, log); }; });
    return command;
  };
  CLI::App& repair = *add("repair", "mends a mesh with the gentlest steps that make it one solid",
                          RepairMode::automatic);
  repair.add_option("--fill-holes", o.fill_holes, "which holes are filled")
      ->check(CLI::IsMember({"small", "all"}));
  repair.add_option("--weld", o.repair.weld_tolerance,
                    "vertices up to this part of the size apart are joined");
  repair.add_option("--thickness", o.repair.thickness,
                    "thickness that sheets are given, as a part of the size");
  add_wrap_options(repair, o.repair);
  add_remesh_options(repair, o, false);
  add_remesh_options(*add("remesh", "another triangulation of a closed surface", RepairMode::off),
                     o, true);
  CLI::App& wrap = *add("wrap", "a closed surface around any set of triangles", RepairMode::wrap);
  add_wrap_options(wrap, o.repair);
  add_remesh_options(wrap, o, false);
}

}  // namespace bem
