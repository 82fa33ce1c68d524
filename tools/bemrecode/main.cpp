/// bemrecode: compresses an uncompressed archive, or compares codecs on it.

#include "archive/archive_reader.hpp"
#include "archive/archive_writer.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "compare.hpp"
#include "recode.hpp"
#include "settings/precompute_settings.hpp"

#include <iostream>

#include <CLI/CLI.hpp>

namespace bem {
namespace {

struct Options {
  std::string input, output, codec = "lowrank";
  double tolerance = 1e-4, ratio = 0;
  std::vector<double> compared;
  bool force = false;
  int threads = 0;
};

void check(const Options& o) {
  const auto refuse = [](const std::string& text) { throw Error(ErrorCode::usage, text); };
  FileRoles files;
  files.reads(o.input);
  files.writes(o.output);
  files.check();
  if (o.output.empty() == o.compared.empty())
    refuse("name either the archive to write, -o OUT.bem, or tolerances to --compare codecs at");
  const Codec* codec = find_codec(o.codec);
  if (!codec || codec->is_lossless())
    refuse("compression is by " + codecs_text(SettingStyle::option, is_lossy) +
           ", not by --codec " + o.codec);
  if (o.ratio != 0 && !codec->takes_ratio())
    refuse("--compression-ratio belongs to " + codecs_text(SettingStyle::option, takes_ratio));
  if (o.ratio != 0 && !(o.ratio >= 1 && o.ratio <= 1e4))
    refuse("--compression-ratio must be from 1 to 10000");
  std::vector<double> tolerances = o.compared;
  tolerances.push_back(o.tolerance);
  for (double t : tolerances)
    if (!(t >= 1e-6 && t <= 0.1)) refuse("tolerances must be from 1e-06 to 0.1");
}

/// The options of the uncompressed archive with another codec.
std::string recoded_options(std::string text, const Codec& from, const CodecOptions& to) {
  const std::string before = from.options_text(CodecOptions(from));
  const std::size_t at = text.find(before);
  require(at != std::string::npos, "an archive names its codec");
  return text.replace(at, before.size(), to.codec->options_text(to));
}

int run(int argc, char** argv) {
  CLI::App app("Compresses an archive of bemprecomp --codec none, or compares codecs on it.",
               "bemrecode");
  set_up_help(app,
              "  bemrecode DENSE.bem -o OUT.bem [options]\n"
              "  bemrecode DENSE.bem --compare TOLERANCE...\n");
  Options o;
  app.add_option("ARCHIVE", o.input, "archive of bemprecomp --codec none")
      ->required()
      ->type_name("");
  app.add_option("-o,--output", o.output, "archive to write")->type_name("OUT.bem");
  app.add_option("--codec", o.codec, "lowrank or haar (lowrank)")->type_name("NAME");
  app.add_option("--codec-tol", o.tolerance, "relative error aimed at (1e-4)")->type_name("X");
  app.add_option("--compression-ratio", o.ratio, "with --codec haar: entries before / kept")
      ->type_name("R");
  app.add_option("--compare", o.compared,
                 "instead: JSON on stdout, codec lowrank at these tolerances and codec haar at the "
                 "same bytes, their errors and those of products")
      ->type_name("X");
  app.add_flag("--force", o.force, "overwrite an existing archive");
  app.add_option("--threads", o.threads, "worker threads (all cores)")->type_name("N");
  if (!parse_command_line(app, argc, argv, "one archive is enough")) return 0;
  check(o);
  if (o.threads > 0) set_thread_count(o.threads);
  if (!o.output.empty()) check_archive_target(o.output, o.force);

  const Archive archive(o.input);
  if (archive.kind() != ModelKind::dynamic)
    throw Error(ErrorCode::archive, o.input + ": is not the archive of a dynamic body");
  Provenance provenance = archive.provenance();
  if (archive.codec().precision() != Precision::float32)
    throw Error(ErrorCode::archive,
                o.input + ": is not an archive of --codec none in single precision");
  const CodecOptions codec(codec_named(o.codec), o.tolerance, o.ratio);
  provenance.options = recoded_options(provenance.options, archive.codec(), codec);
  BodyModel model = archive.load_all();
  if (!o.compared.empty()) {
    std::cout << compare_codecs(model, o.compared).dump(1) << "\n" << std::flush;
    return 0;
  }
  recode(model, codec);
  write_archive(o.output, model, provenance, o.force);
  return 0;
}

}  // namespace
}  // namespace bem

int main(int argc, char** argv) {
  bem::Log log;
  return bem::run_tool(log, [&] { return bem::run(argc, argv); });
}
