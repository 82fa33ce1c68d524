#pragma once

#include "assembly/pair_integrals.hpp"
#include "assembly/patch_rows.hpp"

namespace bem {

/// Two patches between which kernels are integrated. H gets `h_part` of it, which may be zero.
struct PatchPair {
  const PairIntegrals& integrals;
  const SurfacePatch& x;
  const PatchRows& rows;  ///< that are wanted of x
  const SurfacePatch& y;
  double h_part;

  bool with_h() const { return h_part != 0; }
  /// Whether midpoints of edges suffice for both.
  bool is_far(KernelPart part) const {
    return integrals.quadrature().midpoints_suffice(distance(x.box, y.box),
                                                    std::max(x.longest_edge, y.longest_edge), part);
  }
};

}  // namespace bem
