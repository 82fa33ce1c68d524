#pragma once

#include "assembly/block_sums.hpp"
#include "assembly/midpoint_sums.hpp"
#include "assembly/patch_pair.hpp"
#include "assembly/static_sums.hpp"

namespace bem {

/// Integrates two patches that are far from each other by the midpoints of both.
template <class T>
class MidpointPatches {
 public:
  /// Add what the patches have in common to rows places[k] of `to`, for the wanted rows k: dynamic
  /// kernels, and static ones.
  void add_dynamic(const PatchPair& pair, const LaneTable<T>& table, const std::vector<int>& places,
                   BlockSums<T>& to);
  void add_static(const PatchPair& pair, const std::vector<int>& places, BlockSums<T>& to);

 private:
  /// The surface curls of both ends meet in sums over the axes of both: by the axis of x, 1/r and
  /// h h^T/r with the same axis of y, then 1/r with the two others.
  static constexpr std::size_t kForms = 12;

  void evaluate(const PatchPair& pair, const Midpoint& x);
  void combine_curls(const SurfacePatch& y, std::size_t x);
  void add_static_h(const PatchPair& pair, const std::vector<int>& places, BlockSums<T>& to);

  /// Between one point x and those of y.
  AlignedVector<T> inertia_, adjoint_, uniform_;
  AlignedVector<double> static_, by_axis_[3];
  /// By points of x: [x][node or hat of y], as in BlockSums.
  AlignedVector<T> inertia_of_x_, adjoint_of_x_, strain_of_x_;
  AlignedVector<double> static_g_of_x_;
  AlignedVector<double> curls_[3], combined_[3];  ///< [x or row][node of y][kForms], by axis of x
  MidpointBatch batch_;
  StaticBatch static_batch_;
  PairScratch<T> scratch_;
};

}  // namespace bem
