#pragma once

#include "assembly/block_sums.hpp"
#include "assembly/galerkin_static.hpp"
#include "assembly/patch_pair.hpp"

namespace bem {

/// Integrates two patches that are close to each other pair by pair of triangles, by the shape
/// functions of both.
template <class T>
class ShapePatches {
 public:
  /// Add what the patches have in common to rows places[k] of `to`, for the wanted rows k: dynamic
  /// kernels, and static ones.
  void add_dynamic(const PatchPair& pair, const LaneTable<T>& table, const std::vector<int>& places,
                   BlockSums<T>& to);
  void add_static(const PatchPair& pair, const std::vector<int>& places, BlockSums<T>& to);

 private:
  void sum(const PatchPair& pair, const LaneTable<T>& table, std::size_t lanes);
  void sum_static(const PatchPair& pair);

  /// By shapes of x, and shapes or hats of y.
  AlignedVector<T> inertia_, adjoint_, strain_, uniform_;
  AlignedVector<double> static_h_, static_g_;
  /// By shapes of x, and nodes of y.
  AlignedVector<T> by_node_;
  AlignedVector<double> static_by_node_;
  PairBatch batch_;
  PairScratch<T> scratch_;
};

}  // namespace bem
