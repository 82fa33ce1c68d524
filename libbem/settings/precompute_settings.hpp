#pragma once

#include "assembly/spatial_method.hpp"
#include "base/material.hpp"
#include "compress/codec_options.hpp"
#include "model/model_kinds.hpp"
#include "repair/repair_options.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// How messages write a setting and its value.
enum class SettingStyle {
  option,  ///< --codec-tol 1e-3, of the command line
  key      ///< "codec_tol": 1e-3, of a scene
};

/// What determines the matrices of a body beside its mesh and its material: the options of
/// bemprecomp, and the members of "precompute" of a body in a scene.
struct PrecomputeSettings {
  std::optional<double> time_step;  ///< [s], > 0
  ModelKind model = ModelKind::dynamic;
  std::string scheme;  ///< empty: radau2, and bdf1 for the static model
  std::optional<SpatialMethod> method;
  bool measure_growth = false;
  bool energies = false;
  double window = 0;  ///< as PrecomputeOptions: 0 is "auto"
  std::optional<double> history_tolerance;
  std::optional<int> history;
  double quadrature_tolerance = 1e-6;
  std::string codec = "lowrank";
  std::optional<double> codec_tolerance, compression_ratio;
  std::optional<Precision> precision;
  std::optional<InverseKind> inverse;  ///< empty: by the number of nodes
  /// "all", "none" or a file with selections; empty: "all", or what a scene needs.
  std::string loads;
  bool corners_given = false;  ///< else by the discretisation
  std::optional<double> corner_angle_deg;
  Damping damping;
  std::optional<RepairMode> repair;  ///< empty: off for bemprecomp, automatic in scenes
  std::optional<int> nodes;          ///< to which the mesh is remeshed
  bool fill_all_holes = false;
  std::optional<double> thickness;  ///< of sheets that are repaired, over the size

  bool has_load_file() const { return !loads.empty() && loads != "all" && loads != "none"; }
  std::string scheme_name() const;
  /// The discretisation: the one that is given, or the default one.
  SpatialMethod method_or_default() const { return method.value_or(SpatialMethod::galerkin); }
  std::optional<double> corner_angle() const;
  CodecOptions codec_options() const;
  /// What happens to the mesh before anything is computed; `missing` where nothing says so.
  RepairOptions repair_options(RepairMode missing) const;
  /// The settings that determine the matrices of a mesh that is not repaired, but for the time
  /// step, as options in a fixed order; and those that determine what a repair makes of it.
  std::string canonical_text() const;
  std::string repair_text(RepairMode missing) const;
};

/// One setting: option --NAME of bemprecomp, and in a scene the key key().
struct Setting {
  enum class Kind { number, integer, text, flag };

  std::string name;
  Kind kind;
  bool in_scenes;    ///< whether "precompute" has it
  std::string type;  ///< placeholder of the value in help texts
  std::string help;
  /// Throws ErrorCode::usage with a message that begins with `written`, the setting as its reader
  /// wrote it. The text of a flag is "true" or "false".
  void (*set)(PrecomputeSettings& settings, const std::string& written, const std::string& text);

  /// The name with "_" for "-".
  std::string key() const;
};

/// All settings, in the order of the help text.
const std::vector<Setting>& precompute_settings();

/// The name of a setting in the style of its reader: --codec-tol or "codec_tol".
std::string setting_name(SettingStyle style, const std::string& name);
/// A setting with a value: --codec none or "codec": "none".
std::string setting_text(SettingStyle style, const std::string& name, const std::string& value);
class Codec;
/// "--codec haar or --codec lowrank": the codecs with a property.
std::string codecs_text(SettingStyle style, bool (*property)(const Codec&));

/// Refuses settings that do not belong together. Throws ErrorCode::usage.
void check_settings(const PrecomputeSettings& settings, SettingStyle style);

}  // namespace bem
