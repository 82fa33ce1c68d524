#pragma once

#include <cmath>
#include <optional>
#include <string>

namespace bem {

/// A homogeneous, isotropic, linearly elastic material.
struct Material {
  std::string name;
  double density = 0;               ///< rho [kg/m^3], > 0
  double shear_modulus = 0;         ///< mu [Pa], > 0
  double poisson_ratio = 0;         ///< nu in [0, 0.5]; 0.5 is incompressible
  std::optional<double> time_step;  ///< suggested dt [s], > 0

  /// Speed of shear waves c2 = sqrt(mu / rho) [m/s].
  double shear_speed() const { return std::sqrt(shear_modulus / density); }

  /// Squared ratio of the wave speeds (c2/c1)^2 = (1 - 2 nu) / (2 (1 - nu)), in [0, 1/2];
  /// 0 for an incompressible material, whose pressure waves are infinitely fast.
  double kappa() const { return (1 - 2 * poisson_ratio) / (2 * (1 - poisson_ratio)); }
};

/// Material damping of a Kelvin-Voigt solid: its stress is that of the strain plus `time` times
/// that of the strain's rate, so both moduli are multiplied by 1 + s time, s the Laplace variable.
struct Damping {
  double time = 0;  ///< retardation time [s]; 0: none
};

}  // namespace bem
