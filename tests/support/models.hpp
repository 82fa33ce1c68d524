#pragma once

#include "model/precompute.hpp"
#include "support/bodies.hpp"

namespace bem_test {

/// Options for a time step of extent/(lam c2).
inline bem::PrecomputeOptions options_for(const bem::BodyGeometry& geometry,
                                          const bem::Material& material, const std::string& scheme,
                                          double lam) {
  bem::PrecomputeOptions o;
  o.discretisation.material = material;
  o.discretisation.scheme = bem::Scheme::parse(scheme);
  o.discretisation.dt = geometry.extent / (lam * material.shear_speed());
  o.discretisation.history_length = bem::default_history_length(o.discretisation.scheme, lam);
  o.codec = bem::CodecOptions(bem::codec_named("none", bem::Precision::float64));
  o.window = 1;
  o.measure_growth = false;
  return o;
}

/// Of a model without history.
inline bem::PrecomputeOptions quasistatic_options(const bem::BodyGeometry& geometry,
                                                  const bem::Material& material) {
  bem::PrecomputeOptions o = options_for(geometry, material, "bdf1", 1);
  o.kind = bem::ModelKind::quasistatic;
  o.discretisation.dt = bem::quasistatic_time_step(geometry, material);
  o.discretisation.history_length = 0;
  return o;
}

inline bem::BodyGeometry geometry_of(bem::TriangleMesh mesh, double density) {
  return bem::make_geometry(bem::make_surface(std::move(mesh), "test body"), density);
}

}  // namespace bem_test
