#pragma once

#include "mesh/shapes.hpp"
#include "mesh/surface.hpp"
#include "model/precompute.hpp"

#include <string>

namespace bem_bench {

/// A scheme with the number of steps that a shear wave takes across the body with it.
struct Case {
  std::string scheme;
  double lam;
};

/// What the benchmarks of assembly and stepping are run for; benchmark arguments are indices.
inline const Case kCases[] = {{"radau2", 2}, {"theta:0.75", 3.5}, {"bdf2", 3.5}, {"bdf1", 3.5}};

inline bem::BodyGeometry sphere(int subdivisions) {
  constexpr double kRadius = 0.1, kDensity = 1000;
  return bem::make_geometry(bem::make_surface(bem::icosphere(subdivisions, kRadius), "sphere"),
                            kDensity);
}

/// Soft rubber (nu = 0.4) with the time step that belongs to the case.
inline bem::PrecomputeOptions options_for(const bem::BodyGeometry& body, const Case& c) {
  bem::PrecomputeOptions o;
  bem::Discretisation& d = o.discretisation;
  d.material = {"rubber", 1000, 1e4, 0.4, {}};
  d.scheme = bem::Scheme::parse(c.scheme);
  d.dt = body.extent / (c.lam * d.material.shear_speed());
  d.history_length = bem::default_history_length(d.scheme, c.lam);
  o.window = 1;
  o.measure_growth = false;
  return o;
}

}  // namespace bem_bench
