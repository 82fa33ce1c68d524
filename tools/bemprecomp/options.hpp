#pragma once

#include "model/body_model.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bem {

/// The command line of bemprecomp, checked.
struct Options {
  enum class Action { precompute, info, verify, diff };
  Action action = Action::precompute;
  std::vector<std::string> archives;  ///< of --info, --verify and --diff
  bool json = false;                  ///< --info as JSON

  std::string mesh, material, output;
  std::optional<double> dt;  ///< [s]; else the material's
  ModelKind model = ModelKind::dynamic;
  std::string scheme;  ///< a name that Scheme::parse() knows
  SpatialMethod method = SpatialMethod::galerkin;
  bool method_given = false, corners_given = false;  ///< or they are the defaults
  bool measure_growth = false;
  double window = 0;  ///< as PrecomputeOptions: 0 is "auto"
  std::optional<double> history_tolerance;
  std::optional<int> history;
  double quadrature_tolerance = 1e-6;
  CodecOptions codec;
  std::optional<double> corner_angle_deg;
  Damping damping;
  std::optional<InverseKind> inverse;  ///< else by the number of nodes
  std::string loads = "all";           ///< "all", "none" or a file with selections
  double mesh_scale = 1;
  std::optional<int> threads;

  bool dry_run = false, force = false, quiet = false, verbose = false;
  std::string stats, log_file;

  /// The options that determine the matrices, in a fixed order.
  std::string canonical_text() const;
  /// Takes collocation and its other defaults in place of the default discretisation.
  void use_collocation();
};

/// Parses and checks a command line; an empty result means that help or version was printed. Throws
/// ErrorCode::usage.
std::optional<Options> parse_options(int argc, const char* const* argv);

}  // namespace bem
