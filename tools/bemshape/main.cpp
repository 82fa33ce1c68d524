/// bemshape: writes a closed test body as an OBJ file, or changes a mesh.

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "mend.hpp"
#include "mesh/mesh_io.hpp"
#include "mesh/shapes.hpp"
#include "output.hpp"
#include "split.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace {

/// One value for every option of every shape; a subcommand offers those that its shape has.
struct Options {
  std::string output;
  int subdivisions = 3;
  double radius = 1;
  std::vector<double> size{1, 1, 1};
  std::vector<int> divisions{4, 4, 4};
  double grading = 0;
  double width = 1;
  int cells = 8;
  double amplitude = 0.2;
  double major = 1;
  double minor = 0.4;
  int around = 32;
  int across = 16;
  double height = 1;
  double thickness = 0.1;
  int segments = 32;
  int rings = 8;
  double length = 1;
  int wall = 1;
  double cell = 0.1;
  std::uint64_t seed = 1;
};

using Generator = std::function<bem::TriangleMesh(const Options&)>;

class CommandLine {
 public:
  explicit CommandLine(bem::Log& log)
      : log_(log),
        app_("Writes a closed test body as an OBJ file (lengths in metres), or changes a mesh.",
             "bemshape") {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", bem::version_text());
    app_.option_defaults()->always_capture_default();
    add_round_shapes();
    add_box_shapes();
    add_split();
    bem::add_mend_commands(app_, mend_, action_, log_);
  }

  int run(int argc, char** argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app_.exit(e);
      throw bem::Error(bem::ErrorCode::usage, message_of(e) + "; run with --help for the options");
    }
    action_();
    return 0;
  }

 private:
  std::string message_of(const CLI::ParseError& e) const {
    const std::vector<CLI::App*> given = app_.get_subcommands();
    if (!given.empty()) return bem::message_of(*given.front(), e);
    std::string shapes;
    for (const CLI::App* shape : app_.get_subcommands(nullptr))
      shapes += (shapes.empty() ? "" : ", ") + shape->get_name();
    return "name a shape or an action first, one of " + shapes;
  }

  CLI::App& add_shape(const std::string& name, const std::string& help,
                      const Generator& generator) {
    CLI::App& shape = *app_.add_subcommand(name, help);
    shape.option_defaults()->always_capture_default();
    shape
        .add_option("-o,--output", options_.output, "OBJ file to write (overwritten if it exists)")
        ->required();
    shape.callback([this, generator] {
      action_ = [this, generator] {
        bem::check_output_name(options_.output);
        bem::write_obj(options_.output, generator(options_));
      };
    });
    return shape;
  }

  void add_split() {
    CLI::App& split =
        *app_.add_subcommand("split", "writes the separate parts of a mesh as files of their own");
    split.add_option("mesh", split_.input, "mesh file to read")->required();
    split
        .add_option("-o,--output", split_.pattern,
                    "OBJ files to write (overwritten if they exist); %d becomes 0, 1, ...")
        ->required();
    split.callback([this] { action_ = [this] { bem::split_mesh(split_, log_); }; });
  }

  void add_subdivisions(CLI::App& shape) {
    shape.add_option("--subdivisions", options_.subdivisions,
                     "refinements of the icosahedron: 10 * 4^n + 2 vertices");
    shape.add_option("--radius", options_.radius, "radius [m]");
  }

  void add_round_shapes() {
    add_subdivisions(add_shape("icosphere", "sphere from a refined icosahedron",
                               [](auto& o) { return bem::icosphere(o.subdivisions, o.radius); }));
    add_subdivisions(add_shape("star", "sphere with hills and dales: 0.65 to 1.35 radii",
                               [](auto& o) { return bem::star(o.subdivisions, o.radius); }));

    CLI::App& torus = add_shape("torus", "torus around the z axis", [](auto& o) {
      return bem::torus(o.major, o.minor, o.around, o.across);
    });
    torus.add_option("--major", options_.major, "distance of the tube's centre from the axis [m]");
    torus.add_option("--minor", options_.minor, "radius of the tube [m]");
    torus.add_option("--around", options_.around, "cells the long way");
    torus.add_option("--across", options_.across, "cells around the tube");

    CLI::App& cylinder = add_shape("cylinder", "cylinder along z", [](auto& o) {
      return bem::cylinder(o.radius, o.height, o.segments, o.rings);
    });
    cylinder.add_option("--radius", options_.radius, "radius [m]");
    cylinder.add_option("--height", options_.height, "height [m]");
    cylinder.add_option("--segments", options_.segments, "cells around the rim");
    cylinder.add_option("--rings", options_.rings, "layers along the height");

    CLI::App& fish = add_shape("fish", "fish along x with a forked tail",
                               [](auto& o) { return bem::fish(o.length, o.segments); });
    fish.add_option("--length", options_.length, "length [m]");
    fish.add_option("--segments", options_.segments,
                    "cells around its girth, n: about 0.85 n^2 vertices");

    CLI::App& bowl = add_shape("bowl", "thick hemispherical bowl opening towards +z", [](auto& o) {
      return bem::bowl(o.radius, o.thickness, o.segments);
    });
    bowl.add_option("--radius", options_.radius, "outer radius [m]");
    bowl.add_option("--thickness", options_.thickness, "thickness of the wall [m]");
    bowl.add_option("--segments", options_.segments, "cells around the rim");
  }

  void add_box_shapes() {
    for (const std::string name : {"box", "beam"}) {
      CLI::App& box = add_shape(name, "box centred at the origin", [](auto& o) {
        return bem::box({o.size[0], o.size[1], o.size[2]},
                        {o.divisions[0], o.divisions[1], o.divisions[2]}, o.grading);
      });
      box.add_option("--size", options_.size, "lengths along x, y, z [m]")->expected(3);
      box.add_option("--divisions", options_.divisions, "cells along x, y, z")->expected(3);
      box.add_option("--grading", options_.grading, "0 = equal cells .. 1 = fine at the ends");
    }
    CLI::App& bumpy = add_shape("bumpy-cube", "smooth rounded cube with bumps", [](auto& o) {
      return bem::bumpy_cube(o.width, o.cells, o.amplitude);
    });
    bumpy.add_option("--amplitude", options_.amplitude, "height of the bumps over the radius");
    CLI::App& notched = add_shape("notched-cube", "cube without one octant",
                                  [](auto& o) { return bem::notched_cube(o.width, o.cells); });
    for (CLI::App* cube : {&bumpy, &notched}) {
      cube->add_option("--size", options_.width, "width [m]");
      cube->add_option("--divisions", options_.cells, "cells along an edge");
    }
    CLI::App& clip = add_shape("clip", "bar bent to a U, open at +x", [](auto& o) {
      return bem::clip({o.divisions[0], o.divisions[1], o.divisions[2]}, o.wall, o.cell);
    });
    clip.add_option("--divisions", options_.divisions, "cells of its box along x, y, z")
        ->expected(3);
    clip.add_option("--wall", options_.wall, "thickness of the bar in cells");
    clip.add_option("--cell", options_.cell, "width of a cell [m]");
    CLI::App& tetrahedron =
        add_shape("random-tetrahedron", "tetrahedron with corners in the unit cube",
                  [](auto& o) { return bem::random_tetrahedron(o.seed); });
    tetrahedron.add_option("--seed", options_.seed, "which one");
  }

  bem::Log& log_;
  CLI::App app_;
  Options options_;
  bem::SplitOptions split_;
  bem::MendOptions mend_;
  std::function<void()> action_;
};

}  // namespace

int main(int argc, char** argv) {
  bem::Log log;
  bem::catch_interrupts();
  bem::set_interruption_check(bem::check_interrupt);
  return bem::run_tool(log, [&] { return CommandLine(log).run(argc, argv); });
}
