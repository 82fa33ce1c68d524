#include "settings/precompute_settings.hpp"

#include "base/error.hpp"
#include "compress/codec.hpp"
#include "kernels/scheme.hpp"
#include "mesh/describe.hpp"
#include "model/defaults.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace bem {
namespace {

using Settings = PrecomputeSettings;

[[noreturn]] void refuse(const std::string& text) {
  throw Error(ErrorCode::usage, text);
}

/// The number that the text is, if it is one and nothing else.
template <class T>
std::optional<T> number_of(std::string_view text) {
  T value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

template <class T>
T number_in(const std::string& name, const std::string& text, T lowest, T highest) {
  const std::optional<T> value = number_of<T>(text);
  if (value && *value >= lowest && *value <= highest) return *value;
  refuse(name + " must be from " + to_text(lowest) + " to " + to_text(highest) + ", not " + text);
}

double positive(const std::string& name, const std::string& text) {
  const std::optional<double> value = number_of<double>(text);
  if (value && std::isfinite(*value) && *value > 0) return *value;
  refuse(name + " must be a positive number, not " + text);
}

/// The value of this name.
template <class T>
T named(const std::string& name, const std::string& text) {
  if (const std::optional<T> value = find_choice<T>(text)) return *value;
  refuse(name + " is " + choice_list<T>() + ", not \"" + text + "\"");
}

void set_scheme(Settings& s, const std::string& /*name*/, const std::string& text) {
  Scheme::parse(text);
  s.scheme = text;
}

void set_window(Settings& s, const std::string& name, const std::string& text) {
  const std::optional<double> q = text == "auto" ? 0 : number_of<double>(text);
  if (text != "auto" && !(q && *q > 0 && *q <= 1))
    refuse(name + " is auto or a number q with 0 < q <= 1, not \"" + text + "\"");
  s.window = *q;
}

void set_codec(Settings& s, const std::string& name, const std::string& text) {
  if (!find_codec(text, Precision::float32))
    refuse(name + " is " + list_text(codec_names()) + ", not \"" + text + "\"");
  s.codec = text;
}

void set_inverse(Settings& s, const std::string& name, const std::string& text) {
  s.inverse = find_choice<InverseKind>(text);
  if (text != "auto" && !s.inverse)
    refuse(name + " is auto, " + choice_list<InverseKind>() + ", not \"" + text + "\"");
}

void set_corner_angle(Settings& s, const std::string& name, const std::string& text) {
  s.corners_given = text != "auto";
  s.corner_angle_deg = number_of<double>(text);
  const bool angle = s.corner_angle_deg && *s.corner_angle_deg > 0 && *s.corner_angle_deg < 180;
  if (!angle && text != "auto" && text != "none")
    refuse(name + " is auto, none or an angle between 0 and 180, not \"" + text + "\"");
}

void set_damping(Settings& s, const std::string& name, const std::string& text) {
  constexpr std::string_view kLaw = "kelvin_voigt:";
  s.damping = {};
  if (text == "off") return;
  if (text.compare(0, kLaw.size(), kLaw) == 0) {
    const auto time = number_of<double>(std::string_view(text).substr(kLaw.size()));
    if (time && std::isfinite(*time) && *time > 0) {
      s.damping = {*time};
      return;
    }
  }
  refuse(name + " is off or kelvin_voigt:T with a time T > 0 [s], not \"" + text + "\"");
}

void set_fill_holes(Settings& s, const std::string& name, const std::string& text) {
  if (text != "small" && text != "all") refuse(name + " is small or all, not \"" + text + "\"");
  s.fill_all_holes = text == "all";
}

/// The rows of precompute_settings().
std::vector<Setting> make_settings() {
  using Kind = Setting::Kind;
  using Text = const std::string&;
  return {
      {"dt", Kind::number, false, "S", "time step [s]; default: the material's \"time_step\"",
       [](Settings& s, Text name, Text text) { s.time_step = positive(name, text); }},
      {"scheme", Kind::text, true, "NAME", scheme_names() + " (radau2; static models: bdf1)",
       set_scheme},
      {"discretisation", Kind::text, true, "NAME",
       "in space: galerkin, which neither stiffens bodies nor lets motions grow, or collocation, "
       "the paper's (galerkin)",
       [](Settings& s, Text name, Text text) { s.method = named<SpatialMethod>(name, text); }},
      {"measure-growth", Kind::flag, true, "",
       "with galerkin, too, measure how much motions of the free body grow per step (collocation "
       "always does)",
       [](Settings& s, Text, Text text) { s.measure_growth = text == "true"; }},
      {"energies", Kind::flag, true, "",
       "with galerkin and a dense inverse: matrices by which trajectories get the kinetic and the "
       "elastic energy of the body",
       [](Settings& s, Text, Text text) { s.energies = text == "true"; }},
      {"window", Kind::text, true, "q",
       "factor 0 < q <= 1 on the weights per lag, 1 for none; auto: 1, but the weakest that makes "
       "growth <= 1 where growth is measured (auto)",
       set_window},
      {"model", Kind::text, true, "NAME",
       "dynamic; static: a deformation without inertia, for any time step; or rigid: geometry and "
       "mass alone (dynamic)",
       [](Settings& s, Text name, Text text) { s.model = named<ModelKind>(name, text); }},
      {"history-tol", Kind::number, true, "X",
       "length of the history from the size of the weights beyond it",
       [](Settings& s, Text name, Text text) {
         s.history_tolerance = number_in(name, text, 1e-13, 0.5);
       }},
      {"history", Kind::integer, true, "N",
       "length of the history in steps; default: from the time that shear waves need to cross the "
       "body",
       [](Settings& s, Text name, Text text) { s.history = number_in(name, text, 1, 100000); }},
      {"quadrature-tol", Kind::number, true, "X",
       "accuracy of the spatial quadrature: with collocation the relative error aimed at; with "
       "galerkin that of triangles that touch, those apart have up to 3000 times as much (1e-6)",
       [](Settings& s, Text name, Text text) {
         s.quadrature_tolerance = number_in(name, text, 1e-11, 0.1);
       }},
      {"codec", Kind::text, true, "NAME",
       "lowrank; none: every entry; or haar: the largest Haar coefficients, to compare with "
       "(lowrank)",
       set_codec},
      {"codec-tol", Kind::number, true, "X", "relative error aimed at by the codec (1e-4)",
       [](Settings& s, Text name, Text text) {
         s.codec_tolerance = number_in(name, text, 1e-6, 0.1);
       }},
      {"compression-ratio", Kind::number, true, "R",
       "with codec haar, in place of a tolerance: entries before / coefficients kept",
       [](Settings& s, Text name, Text text) {
         s.compression_ratio = number_in(name, text, 1.0, 1e4);
       }},
      {"precision", Kind::text, true, "NAME", "with codec none: float32 or float64 (float32)",
       [](Settings& s, Text name, Text text) { s.precision = named<Precision>(name, text); }},
      {"inverse", Kind::text, true, "NAME",
       "how steps solve with the matrices of lag 0: dense (the stored inverse), iterative (no "
       "inverse is computed), or auto: iterative above 8000 nodes (auto)",
       set_inverse},
      {"loads", Kind::text, true, "all|none|FILE",
       "where contacts, joints and fixed vertices may act: all, none, or a JSON file with "
       "selections of vertices as in scenes (all)",
       [](Settings& s, Text, Text text) { s.loads = text; }},
      {"corner-angle-deg", Kind::text, true, "A",
       "double nodes for the tractions of fixed and joined vertices along edges sharper than this, "
       "none, or auto: 40 with galerkin, none with collocation (auto)",
       set_corner_angle},
      {"damping", Kind::text, true, "LAW",
       "material damping: kelvin_voigt:T with the retardation time T [s], or off (off)",
       set_damping},
      {"repair", Kind::text, true, "MODE",
       "what happens to a mesh that is no closed surface of one solid: off: it is refused; auto: "
       "the gentlest step that works mends it; wrap: it is wrapped in any case (off, in scenes "
       "auto)",
       [](Settings& s, Text name, Text text) { s.repair = named<RepairMode>(name, text); }},
      {"nodes", Kind::integer, true, "N", "remesh to about so many vertices (the mesh as it is)",
       [](Settings& s, Text name, Text text) {
         s.nodes = number_in(name, text, kFewestNodes, kMostNodes);
       }},
      {"fill-holes", Kind::text, true, "small|all",
       "with repair auto: holes that are closed (small)", set_fill_holes},
      {"thickness", Kind::number, true, "X",
       "with repair auto: of sheets, as a part of the size of the mesh (0.02)",
       [](Settings& s, Text name, Text text) { s.thickness = number_in(name, text, 1e-6, 0.5); }}};
}

/// Refuses what a model without history does not have.
void check_static(const Settings& s, SettingStyle style) {
  const std::string model = setting_text(style, "model", "static");
  if (!Scheme::parse(s.scheme_name()).is_multistep())
    refuse(model + " moves its frame by a scheme with one stage: bdf1, bdf2 or theta:T");
  if (s.history || s.history_tolerance) refuse(model + " has no history");
  if (s.damping.time > 0) refuse(model + " has no damping");
  if (s.inverse == InverseKind::iterative)
    refuse(model + " needs " + setting_text(style, "inverse", "dense"));
  if (s.window != 0 || s.measure_growth)
    refuse(model + " has no growth: leave " + setting_name(style, "window") + " and " +
           setting_name(style, "measure-growth") + " away");
}

/// Refuses energies where there are none.
void check_energies(const Settings& s, SettingStyle style) {
  if (!s.energies) return;
  const std::string name = setting_name(style, "energies") + " needs ";
  if (s.method == SpatialMethod::collocation)
    refuse(name + setting_text(style, "discretisation", choice_name(SpatialMethod::galerkin)));
  if (s.inverse == InverseKind::iterative)
    refuse(name + setting_text(style, "inverse", choice_name(InverseKind::dense)));
}

/// Refuses what a codec does not know.
void check_codec(const Settings& s, SettingStyle style) {
  const auto name = [&](const char* setting) { return setting_name(style, setting); };
  const auto belongs = [&](const char* setting, bool (*property)(const Codec&)) {
    refuse(name(setting) + " belongs to " + codecs_text(style, property));
  };
  const Codec& codec = *s.codec_options().codec;
  if (s.codec_tolerance && codec.is_lossless()) belongs("codec-tol", is_lossy);
  if (s.compression_ratio && !codec.takes_ratio()) belongs("compression-ratio", takes_ratio);
  if (s.compression_ratio && s.codec_tolerance)
    refuse("use either " + name("compression-ratio") + " or " + name("codec-tol"));
  if (!codec.is_lossless() && s.precision)
    refuse(name("precision") + " belongs to " + setting_text(style, "codec", "none") + "; use " +
           name("codec-tol") + " with " + setting_text(style, "codec", s.codec));
  if (!codec.is_sampled() && s.has_load_file())
    refuse(name("loads") + " with a file needs " + setting_text(style, "codec", "lowrank"));
}

}  // namespace

const std::vector<Setting>& precompute_settings() {
  static const std::vector<Setting> settings = make_settings();
  return settings;
}

std::string Setting::key() const {
  std::string key = name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::string setting_name(SettingStyle style, const std::string& name) {
  if (style == SettingStyle::option) return "--" + name;
  std::string key = name;
  std::replace(key.begin(), key.end(), '-', '_');
  return "\"" + key + "\"";
}

std::string setting_text(SettingStyle style, const std::string& name, const std::string& value) {
  const bool option = style == SettingStyle::option;
  return setting_name(style, name) + (option ? " " + value : ": \"" + value + "\"");
}

std::string codecs_text(SettingStyle style, bool (*property)(const Codec&)) {
  std::vector<std::string> texts;
  for (const std::string& name : codecs_with(property))
    texts.push_back(setting_text(style, "codec", name));
  return list_text(texts);
}

void check_settings(const PrecomputeSettings& s, SettingStyle style) {
  check_codec(s, style);
  if (s.model == ModelKind::quasistatic) check_static(s, style);
  if (s.model != ModelKind::rigid) check_energies(s, style);
  if (s.history && s.history_tolerance)
    refuse("use either " + setting_name(style, "history") + " or " +
           setting_name(style, "history-tol"));
}

std::string PrecomputeSettings::scheme_name() const {
  if (!scheme.empty()) return scheme;
  return model == ModelKind::quasistatic ? "bdf1" : "radau2";
}

std::optional<double> PrecomputeSettings::corner_angle() const {
  return corners_given ? corner_angle_deg : default_corner_angle(method_or_default());
}

CodecOptions PrecomputeSettings::codec_options() const {
  CodecOptions options(*find_codec(codec, precision.value_or(Precision::float32)));
  if (codec_tolerance) options.tolerance = *codec_tolerance;
  if (compression_ratio) options.ratio = *compression_ratio;
  return options;
}

std::string PrecomputeSettings::canonical_text() const {
  if (model == ModelKind::rigid) return "--model rigid";
  std::string text = "--scheme " + Scheme::parse(scheme_name()).name();
  const bool dynamic = model == ModelKind::dynamic;
  const SpatialMethod space = method_or_default();
  if (space != SpatialMethod::collocation) text += " --discretisation " + choice_name(space);
  if (dynamic) text += " --window " + (window == 0 ? "auto" : to_text(window));
  if (history) text += " --history " + std::to_string(*history);
  if (history_tolerance) text += " --history-tol " + to_text(*history_tolerance);
  text += " --quadrature-tol " + to_text(quadrature_tolerance);
  text += " --model " + choice_name(model);
  const CodecOptions codecs = codec_options();
  text += " " + codecs.codec->options_text(codecs);
  if (damping.time > 0) text += " --damping kelvin_voigt:" + to_text(damping.time);
  if (energies) text += " --energies";
  if (inverse) text += " --inverse " + choice_name(*inverse);
  if (!loads.empty() && loads != "all") text += " --loads " + loads;
  const std::optional<double> corners = corner_angle();
  return text + " --corner-angle-deg " + (corners ? to_text(*corners) : "none");
}

RepairOptions PrecomputeSettings::repair_options(RepairMode missing) const {
  RepairOptions options;
  options.mode = repair.value_or(missing);
  options.fill_all_holes = fill_all_holes;
  if (thickness) options.thickness = *thickness;
  options.nodes = nodes;
  return options;
}

std::string PrecomputeSettings::repair_text(RepairMode missing) const {
  const RepairOptions options = repair_options(missing);
  std::string text = " --repair " + choice_name(options.mode);
  if (options.fill_all_holes) text += " --fill-holes all";
  if (thickness) text += " --thickness " + to_text(*thickness);
  if (nodes) text += " --nodes " + std::to_string(*nodes);
  return text;
}

}  // namespace bem
