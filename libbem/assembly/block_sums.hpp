#pragma once

#include "assembly/galerkin_rows.hpp"
#include "assembly/surface_patch.hpp"

namespace bem {

/// Some rows of the matrices (GalerkinRows) with the nodes or hats of a patch of y, before they are
/// put together.
template <class T>
struct BlockSums {
  /// Numbers for a 3 x 3 block of static kernels: nine, up to whole vectors.
  static constexpr std::size_t kStaticEntry = 12;

  std::size_t lanes = 0;  ///< that are stored; in later ones all kernels vanish
  std::size_t nodes = 0, hats = 0;
  AlignedVector<T> inertia, adjoint;         ///< [row][node or hat][3x3 entry][lane]
  AlignedVector<T> strain;                   ///< [row][3 axes x 6][lane]
  AlignedVector<double> static_h, static_g;  ///< [row][node or hat][kStaticEntry]

  /// Zeros.
  void start(std::size_t rows, const SurfacePatch& y, std::size_t lane_count) {
    lanes = lane_count;
    nodes = y.nodes.size();
    hats = y.hats.size();
    set_zero(inertia, rows * nodes * 9 * lanes);
    set_zero(adjoint, rows * hats * 9 * lanes);
    set_zero(strain, rows * 18 * lanes);
    set_zero(static_h, rows * nodes * kStaticEntry);
    set_zero(static_g, rows * hats * kStaticEntry);
  }
};

}  // namespace bem
