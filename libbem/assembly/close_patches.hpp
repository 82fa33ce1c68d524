#pragma once

#include "assembly/block_sums.hpp"
#include "assembly/galerkin_static.hpp"
#include "assembly/pair_integrals.hpp"
#include "assembly/patch_rows.hpp"

namespace bem {

/// Integrates the close pairs of triangles of two patches by rules that are made for them, and
/// takes away what the rule of midpoints gives for these pairs.
template <class T>
class ClosePatches {
 public:
  /// Adds that to rows places[k] of `to`, for the wanted rows k of x; y is a part of the patch of
  /// `to`. H gets `h_part` of it, which may be zero.
  void add(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
           const PatchParts::Part& y, const LaneTable<T>& table, double h_part,
           const std::vector<int>& places, BlockSums<T>& to);

 private:
  using Pairs = std::vector<std::array<int, 2>>;  // numbers of triangles in the patches

  static Pairs close_pairs(const PairQuadrature& quadrature, const SurfacePatch& x,
                           const SurfacePatch& y, KernelPart part);
  void sum(const PairIntegrals& pairs, const SurfacePatch& x, const SurfacePatch& y,
           const Pairs& close, const LaneTable<T>& table, bool with_h, std::size_t lanes);
  void sum_static(const PairIntegrals& pairs, const SurfacePatch& x, const SurfacePatch& y,
                  const Pairs& close, bool with_h);

  /// By shapes of x, and shapes or hats of y.
  AlignedVector<T> inertia_, adjoint_, strain_, uniform_;
  AlignedVector<double> static_h_, static_g_;
  /// By nodes of y, and by rows.
  AlignedVector<T> by_node_, rows_;
  AlignedVector<double> static_by_node_, static_rows_;
  PairBatch batch_;
  PairScratch<T> scratch_;
};

}  // namespace bem
