/// bemview: makes a page for browsers, or a file for other programs, of a trajectory of bemsim.

#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/text.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "files/pending_file.hpp"
#include "output/exported_file.hpp"
#include "output/trajectory_animation.hpp"
#include "page.hpp"
#include "viewer_shell.hpp"

#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

constexpr double kLargePage = 1e8;  // bytes from which browsers become slow

void add_options(CLI::App& app, ViewOptions& o) {
  app.add_option("TRAJECTORY", o.trajectory, "trajectory.h5 of bemsim")->required()->type_name("");
  app.add_option("-o,--output", o.output,
                 "page to write (.html), or file for other programs (.usda, .glb)")
      ->required()
      ->type_name("VIEW.html");
  app.add_flag("--force", o.force, "overwrite an existing page");
  app.add_option("--every", o.every, "show every K-th frame of the file (1)")->type_name("K");
  app.add_option("--fps", o.rate, "show R frames per second of simulated time, the nearest ones")
      ->type_name("R");
  app.add_option("--bodies", o.bodies, "show these bodies alone")->type_name("NAME");
  app.add_option("--fields", o.fields,
                 "offer these colours alone: displacement, speed, tractions, von_mises as far as "
                 "the file has them, or none")
      ->type_name("NAME");
  app.add_option("--title", o.title, "title of the page (name of the trajectory's folder)")
      ->type_name("T");
}

void check(const ViewOptions& o) {
  FileRoles files;
  files.reads(o.trajectory);
  files.writes(o.output);
  files.check();
  if (!o.title.empty() && export_kind_of(o.output))
    throw Error(ErrorCode::usage, "--title belongs to pages, and " + o.output + " is none");
  if (o.every < 1) throw Error(ErrorCode::usage, "--every must be at least 1");
  if (!(o.rate >= 0 && std::isfinite(o.rate)))
    throw Error(ErrorCode::usage, "--fps must be positive");
  const auto status = std::filesystem::status(o.output);
  if (std::filesystem::is_directory(status))
    throw Error(ErrorCode::usage, o.output + ": is a directory; name a file to write");
  if (std::filesystem::exists(status) && !o.force)
    throw Error(ErrorCode::usage, o.output + ": exists already; use --force to overwrite it");
}

std::string title_of(const ViewOptions& o) {
  if (!o.title.empty()) return o.title;
  const std::string folder =
      std::filesystem::absolute(o.trajectory).parent_path().filename().string();
  return folder.empty() ? "trajectory" : folder;
}

/// Returns the bytes of the file.
double write_export(const ExportKind& kind, const ViewOptions& o) {
  PendingFile file(o.output);
  const Recording recording(o);
  AnimationChoice choice{recording.bodies(), recording.frames()};
  if (!o.fields.empty()) choice.fields = recording.datasets();
  const double bytes = export_scene(kind, animated_scene(recording.file(), choice), file);
  file.commit(o.force ? ExistingFile::replace : ExistingFile::keep);
  return bytes;
}

/// Returns the bytes of the page.
double write_page(const ViewOptions& o, ProgressBar& bar) {
  PendingFile file(o.output);
  const Recording recording(o);
  const Survey found = survey(recording, [&](double share) {
    check_interrupt();
    bar.update("reading", share);
  });
  double bytes = 0;
  write_page(
      PageData(recording, found, title_of(o)), viewer_shell(),
      [&](const std::string& part) {
        check_interrupt();
        file.append(part);
        bytes += static_cast<double>(part.size());
      },
      [&](double share) { bar.update("writing", share); });
  bar.finish();
  file.commit(o.force ? ExistingFile::replace : ExistingFile::keep);
  return bytes;
}

int run(int argc, char** argv, Log& log) {
  CLI::App app(
      "Makes one HTML file of a trajectory: it plays in a browser, without network and without "
      "other files. Positions are rounded to 1/131070 of a body's box along each axis, "
      "colours to 1/8190 of their largest value. Or makes a file for other programs: .usda "
      "(Universal Scene Description) or .glb (glTF).",
      "bemview");
  set_up_help(app, "  bemview TRAJECTORY.h5 -o VIEW.html [options]");
  ViewOptions options;
  bool quiet = false;
  add_options(app, options);
  app.add_flag("-q,--quiet", quiet, "warnings and errors only");
  if (!parse_command_line(app, argc, argv, "one trajectory is enough")) return 0;
  if (quiet) log.set_verbosity(Verbosity::quiet);
  check(options);
  set_interruption_check(check_interrupt);
  if (const ExportKind* kind = export_kind_of(options.output)) {
    log.info(options.output + ": " + bytes_text(write_export(*kind, options)));
    return 0;
  }
  ProgressBar bar(log);
  const double bytes = write_page(options, bar);
  log.info(options.output + ": " + bytes_text(bytes));
  if (bytes > kLargePage)
    log.warning(
        "browsers take long to open a page of this size; --every, --fps, --bodies and "
        "--fields make it smaller");
  return 0;
}

}  // namespace
}  // namespace bem

int main(int argc, char** argv) {
  bem::Log log;
  bem::catch_interrupts();
  return bem::run_tool(log, [&] { return bem::run(argc, argv, log); });
}
