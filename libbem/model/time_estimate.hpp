#pragma once

#include "assembly/quadrature_count.hpp"
#include "model/precompute.hpp"

namespace bem {

/// How long the phases of precompute() will take on all threads of this machine [s], from the times
/// of bodies that were measured (docs/performance.md); mostly right to a third.
struct TimeEstimate {
  double assembly = 0;  ///< and compression
  double inversion = 0, growth = 0;
  double total() const { return assembly + inversion + growth; }
};

/// Measures the speed of this machine, for half a second. `quadrature` is that of the nodes' mesh.
TimeEstimate estimate_time(const BodyGeometry& geometry, const PrecomputeOptions& options,
                           const QuadratureCount& quadrature);

}  // namespace bem
