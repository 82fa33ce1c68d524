#pragma once

#include "model/body_model.hpp"

#include <string>

// Names inside an archive, for its writer and reader; docs/archive-format.md describes them.

namespace bem {

/// Attribute "model" of the root.
inline const char* model_name(ModelKind kind) {
  return kind == ModelKind::rigid ? "rigid" : "dynamic";
}
inline constexpr char kArchiveCodec[] = "none";

/// "lag_001".
inline std::string lag_name(int lag) {
  const std::string digits = std::to_string(lag);
  return "lag_" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

/// Dataset of one component of a lag matrix; `matrix` is "h" or "g".
inline std::string lag_path(const std::string& matrix, int lag, int component) {
  return "/matrices/" + matrix + "/" + lag_name(lag) + "/component_" + std::to_string(component);
}

/// Group with the datasets "real" and, for a complex matrix, "imaginary" of one component of a
/// matrix of lag 0.
inline std::string initial_path(const std::string& matrix, std::size_t component) {
  return "/matrices/" + matrix + "/component_" + std::to_string(component);
}

inline constexpr char kBodyForcePath[] = "/matrices/body_force";

/// Accelerations that balance static right-hand sides and nodal tractions, [6, 3N] each.
inline constexpr char kBalancePath[] = "/matrices/balance/load";
inline constexpr char kTractionBalancePath[] = "/matrices/balance/traction";

}  // namespace bem
