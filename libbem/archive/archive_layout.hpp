#pragma once

#include "model/body_model.hpp"

#include <string>

// Names inside an archive, for its writer and reader; docs/archive-format.md describes them.

namespace bem {

/// Names of the matrices of lag 0: that of displacements, and that of tractions.
inline const char* initial_name(InverseKind kind, bool tractions) {
  if (kind == InverseKind::iterative) return tractions ? "initial_g" : "initial_h";
  return tractions ? "traction_response" : "inverse";
}

/// "lag_001".
inline std::string lag_name(int lag) {
  const std::string digits = std::to_string(lag);
  return "lag_" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

/// Groups of the matrix families.
inline std::string lags_path(const std::string& matrix) {
  return "/matrices/" + matrix;
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

/// Unit of a matrix, by its name.
inline const char* matrix_unit(SpatialMethod method, const std::string& name) {
  if (name == "traction_response") return "m/Pa";
  if (method == SpatialMethod::collocation)
    return name == "g" || name == "initial_g" ? "m/Pa" : "1";
  if (name == "h") return "kg";
  if (name == "inverse") return "m/N";
  return name == "initial_h" ? "N/m" : "m^2";
}

/// Group of the stiffness D(0) of the inertial form.
inline constexpr char kStiffness[] = "/matrices/stiffness";

/// Groups of the energies, and the dataset of such a family of one matrix.
inline constexpr char kEnergyStiffness[] = "/matrices/energy_stiffness";
inline constexpr char kEnergyMass[] = "/matrices/energy_mass";
inline FamilyPlace single_place(const char* group) {
  return {group, {std::string(group) + "/real"}};
}

/// The datasets of an uncompressed family of lags, in the order of their lag indices.
inline std::vector<std::string> lag_paths(const std::string& matrix, int history_length,
                                          int components) {
  std::vector<std::string> paths;
  for (int lag = 1; lag <= history_length; ++lag)
    for (int m = 0; m < components; ++m) paths.push_back(lag_path(matrix, lag, m));
  return paths;
}

/// Those of a matrix of lag 0 with `parts` 1 or 2.
inline std::vector<std::string> initial_paths(const std::string& matrix, std::size_t component,
                                              int parts) {
  std::vector<std::string> paths = {initial_path(matrix, component) + "/real"};
  if (parts > 1) paths.push_back(initial_path(matrix, component) + "/imaginary");
  return paths;
}

/// Columns of body forces: by the accelerations of the frame, and by its rotation.
inline constexpr char kBodyForce[] = "body_force";
inline constexpr char kCentrifugal[] = "centrifugal";

/// Accelerations that balance static right-hand sides and nodal tractions, [6, 3N] each.
inline constexpr char kBalancePath[] = "/matrices/balance/load";
inline constexpr char kTractionBalancePath[] = "/matrices/balance/traction";

/// Forces and torques of nodal tractions at lag 0, of the inertial form: [6, 3N] by component.
inline constexpr char kTractionMoments[] = "balance/traction_moments";

}  // namespace bem
