#pragma once

#include "assembly/spatial_method.hpp"
#include "base/material.hpp"
#include "kernels/scheme.hpp"

namespace bem {

/// What determines the matrices of a body besides its mesh.
struct Discretisation {
  Material material;
  Scheme scheme = Scheme::radau2();
  double dt = 0;           ///< [s]
  int history_length = 0;  ///< number of past steps kept; multistep methods: >= 0, others >= 1
  double quadrature_tolerance = 1e-6;
  Damping damping = {};
  SpatialMethod method = SpatialMethod::collocation;

  bool is_galerkin() const { return method == SpatialMethod::galerkin; }
};

/// |s|_max dt of the scheme: the largest modulus on the unit circle of the principal eigenvalue of
/// Delta, and of others that are weakly damped. (That of radau2 is strongly damped where it is
/// larger than the principal one.)
double largest_symbol(const Scheme& scheme);

/// |s|_max/c2 [1/m].
double largest_wave_number(const Discretisation& discretisation);

}  // namespace bem
