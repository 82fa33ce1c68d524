#include "options.hpp"

#include "assembly/discretisation.hpp"
#include "base/error.hpp"
#include "common/cli.hpp"
#include "common/command_line.hpp"
#include "common/file_roles.hpp"
#include "kernels/scheme.hpp"
#include "mesh/describe.hpp"
#include "model/defaults.hpp"
#include "scene/named_materials.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <string_view>

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
  std::string method = choice_name(Options().method), window = "auto", model = "dynamic",
              codec = "lowrank", corner_angle = "auto", precision = "float32", inverse = "auto",
              damping = "off";
  std::optional<double> codec_tolerance, compression_ratio;
  bool precision_given = false;
};

void add_matrix_options(CLI::App& app, Typed& t) {
  Options& o = t.options;
  app.option_defaults()->group("Matrices");
  app.add_option("--dt", o.dt, "time step [s]; default: the material's \"time_step\"")
      ->type_name("S");
  app.add_option("--scheme", o.scheme, scheme_names() + " (radau2; --model static: bdf1)")
      ->type_name("NAME");
  app.add_option("--discretisation", t.method,
                 "in space: galerkin, which neither stiffens bodies nor lets motions grow, or "
                 "collocation, the paper's (" +
                     t.method + ")")
      ->type_name("NAME");
  app.add_flag("--measure-growth", o.measure_growth,
               "with galerkin, too, measure how much motions of the free body grow per step "
               "(collocation always does)");
  app.add_option("--window", t.window,
                 "factor 0 < q <= 1 on the weights per lag, 1 for none; auto: 1, but the weakest "
                 "that makes growth <= 1 where growth is measured (auto)")
      ->type_name("q");
  app.add_option(
         "--model", t.model,
         "dynamic; static: a deformation without inertia, for any time step; or rigid: geometry "
         "and mass alone (dynamic)")
      ->type_name("NAME");
  app.add_option("--history-tol", o.history_tolerance,
                 "length of the history from the size of the weights beyond it")
      ->type_name("X");
  app.add_option("--history", o.history,
                 "length of the history in steps; default: from the time that shear waves need to "
                 "cross the body")
      ->type_name("N");
  app.add_option("--quadrature-tol", o.quadrature_tolerance,
                 "relative error aimed at by the spatial quadrature (1e-6)")
      ->type_name("X");
  app.add_option("--codec", t.codec,
                 "lowrank; none: every entry; or haar: the largest Haar coefficients, to compare "
                 "with (lowrank)")
      ->type_name("NAME");
  app.add_option("--codec-tol", t.codec_tolerance, "relative error aimed at by the codec (1e-4)")
      ->type_name("X");
  app.add_option("--compression-ratio", t.compression_ratio,
                 "with --codec haar, in place of --codec-tol: entries before / coefficients kept")
      ->type_name("R");
  app.add_option("--precision", t.precision, "with --codec none: float32 or float64 (float32)")
      ->type_name("NAME");
  app.add_option("--inverse", t.inverse,
                 "how steps solve with the matrices of lag 0: dense (the stored inverse), "
                 "iterative (no inverse is computed), or auto: iterative above 8000 nodes (auto)")
      ->type_name("NAME");
  app.add_option("--loads", o.loads,
                 "where contacts, joints and fixed vertices may act: all, none, or a JSON file "
                 "with selections of vertices as in scenes (all)")
      ->type_name("all|none|FILE");
  app.add_option("--corner-angle-deg", t.corner_angle,
                 "double nodes for the tractions of fixed and joined vertices along edges sharper "
                 "than this, none, or auto: 40 with galerkin, none with collocation (auto)")
      ->type_name("A");
  app.add_option("--damping", t.damping,
                 "material damping: kelvin_voigt:T with the retardation time T [s], or off (off)")
      ->type_name("LAW");
  app.add_option("--mesh-scale", o.mesh_scale, "factor on the coordinates of the mesh (1)")
      ->type_name("F");
}

void add_options(CLI::App& app, Typed& t) {
  Options& o = t.options;
  app.add_option("MESH", o.mesh, "closed triangle mesh in any format that assimp reads")
      ->type_name("");
  app.add_option("MATERIAL", o.material, "material JSON, or the name of a material")->type_name("");
  add_matrix_options(app, t);
  app.option_defaults()->group("Run");
  app.add_option("-o,--output", o.output, "archive to write")->type_name("BODY.bem");
  app.add_flag("--force", o.force, "overwrite an existing archive");
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

double number_in(const std::string& option, double value, double lowest, double highest) {
  if (value >= lowest && value <= highest) return value;
  refuse(option + " must be from " + to_text(lowest) + " to " + to_text(highest) + ", not " +
         to_text(value));
}

double positive(const std::string& option, double value) {
  if (std::isfinite(value) && value > 0) return value;
  refuse(option + " must be a positive number, not " + to_text(value));
}

/// The value of this name.
template <class T>
T parse_choice(const std::string& option, const std::string& text) {
  if (const std::optional<T> value = find_choice<T>(text)) return *value;
  refuse(option + " is " + choice_list<T>() + ", not \"" + text + "\"");
}

std::optional<InverseKind> parse_inverse(const std::string& text) {
  if (text == "auto") return std::nullopt;
  if (const auto kind = find_choice<InverseKind>(text)) return kind;
  refuse("--inverse is auto, " + choice_list<InverseKind>() + ", not \"" + text + "\"");
}

/// The number that the text is, if it is one and nothing else.
std::optional<double> number_of(std::string_view text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

double parse_window(const std::string& text) {
  if (text == "auto") return 0;
  const std::optional<double> q = number_of(text);
  if (q && *q > 0 && *q <= 1) return *q;
  refuse("--window is auto or a number q with 0 < q <= 1, not \"" + text + "\"");
}

std::optional<double> parse_corner_angle(const std::string& text, SpatialMethod method) {
  if (text == "auto") return default_corner_angle(method);
  if (text == "none") return std::nullopt;
  const std::optional<double> degrees = number_of(text);
  if (degrees && *degrees > 0 && *degrees < 180) return degrees;
  refuse("--corner-angle-deg is auto, none or an angle between 0 and 180, not \"" + text + "\"");
}

Damping parse_damping(const std::string& text) {
  constexpr std::string_view kLaw = "kelvin_voigt:";
  if (text == "off") return {};
  if (text.compare(0, kLaw.size(), kLaw) == 0) {
    const std::optional<double> time = number_of(std::string_view(text).substr(kLaw.size()));
    if (time && std::isfinite(*time) && *time > 0) return {*time};
  }
  refuse("--damping is off or kelvin_voigt:T with a time T > 0 [s], not \"" + text + "\"");
}

/// Refuses options that do not belong together.
CodecOptions parse_codec(const Typed& t) {
  const Codec* codec = find_codec(t.codec, parse_choice<Precision>("--precision", t.precision));
  if (!codec) refuse("--codec is " + list_text(codec_names()) + ", not \"" + t.codec + "\"");
  if (t.codec_tolerance && codec->is_lossless())
    refuse("--codec-tol belongs to " + codec_options_with(is_lossy));
  if (t.compression_ratio && !codec->takes_ratio())
    refuse("--compression-ratio belongs to " + codec_options_with(takes_ratio));
  if (t.compression_ratio && t.codec_tolerance)
    refuse("use either --compression-ratio or --codec-tol");
  if (!codec->is_lossless() && t.precision_given)
    refuse("--precision belongs to --codec none; use --codec-tol with --codec " + t.codec);
  if (!codec->is_sampled() && t.options.loads != "all" && t.options.loads != "none")
    refuse("--loads with a file needs --codec lowrank");
  CodecOptions options(*codec);
  if (t.codec_tolerance)
    options.tolerance = number_in("--codec-tol", *t.codec_tolerance, 1e-6, 0.1);
  if (t.compression_ratio)
    options.ratio = number_in("--compression-ratio", *t.compression_ratio, 1, 1e4);
  return options;
}

/// Refuses what a model without history does not have.
void check_static(const Options& o, const Scheme& scheme) {
  if (!scheme.is_multistep())
    refuse("--model static moves its frame by a scheme with one stage: bdf1, bdf2 or theta:T");
  if (o.history || o.history_tolerance) refuse("--model static has no history");
  if (o.damping.time > 0) refuse("--model static has no damping");
  if (o.inverse == InverseKind::iterative) refuse("--model static needs --inverse dense");
  if (o.window != 0 || o.measure_growth)
    refuse("--model static has no growth: leave --window and --measure-growth away");
}

void check_inputs(const Options& o) {
  if (o.mesh.empty() || o.material.empty())
    refuse("give a mesh and a material: bemprecomp MESH MATERIAL -o BODY.bem");
  if (o.output.empty() && !o.dry_run) refuse("name the archive to write: -o BODY.bem");
  if (o.dt) positive("--dt", *o.dt);
  positive("--mesh-scale", o.mesh_scale);
  const Scheme scheme = Scheme::parse(o.scheme);
  if (o.model == ModelKind::quasistatic) check_static(o, scheme);
  if (o.history && o.history_tolerance) refuse("use either --history or --history-tol");
  if (o.history) number_in("--history", *o.history, 1, 100000);
  if (o.history_tolerance) number_in("--history-tol", *o.history_tolerance, 1e-13, 0.5);
  number_in("--quadrature-tol", o.quadrature_tolerance, 1e-11, 0.1);
}

void check_distinct_files(const Options& o) {
  FileRoles files;
  for (const std::string& path : o.archives) files.reads(path);
  files.reads(o.mesh);
  if (!is_named_material(o.material)) files.reads(o.material);
  if (o.loads != "all" && o.loads != "none") files.reads(o.loads);
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
  if (o.threads) number_in("--threads", *o.threads, 1, 4096);
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
    o.model = parse_choice<ModelKind>("--model", t.model);
    t.precision_given = given("--precision") > 0;
    o.codec = parse_codec(t);
    if (o.scheme.empty()) o.scheme = o.model == ModelKind::quasistatic ? "bdf1" : "radau2";
    o.method = parse_choice<SpatialMethod>("--discretisation", t.method);
    o.method_given = given("--discretisation") > 0;
    o.corners_given = t.corner_angle != "auto";
    o.corner_angle_deg = parse_corner_angle(t.corner_angle, o.method);
    o.damping = parse_damping(t.damping);
    o.window = parse_window(t.window);
    o.inverse = parse_inverse(t.inverse);
    check_inputs(o);
  }
  check_distinct_files(o);
  return o;
}

}  // namespace

std::string Options::canonical_text() const {
  if (model == ModelKind::rigid) return "--model rigid";
  std::string text = "--scheme " + Scheme::parse(scheme).name();
  const bool dynamic = model == ModelKind::dynamic;
  if (method != SpatialMethod::collocation) text += " --discretisation " + choice_name(method);
  if (dynamic) text += " --window " + (window == 0 ? "auto" : to_text(window));
  if (history) text += " --history " + std::to_string(*history);
  if (history_tolerance) text += " --history-tol " + to_text(*history_tolerance);
  text += " --quadrature-tol " + to_text(quadrature_tolerance);
  text += " --model " + choice_name(model);
  text += " " + codec.codec->options_text(codec);
  if (damping.time > 0) text += " --damping kelvin_voigt:" + to_text(damping.time);
  if (inverse) text += " --inverse " + choice_name(*inverse);
  if (loads != "all") text += " --loads " + loads;
  return text + " --corner-angle-deg " + (corner_angle_deg ? to_text(*corner_angle_deg) : "none");
}

void Options::use_collocation() {
  method = SpatialMethod::collocation;
  if (!corners_given) corner_angle_deg = parse_corner_angle("auto", method);
}

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
