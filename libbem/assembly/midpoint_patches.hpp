#pragma once

#include "assembly/block_sums.hpp"
#include "assembly/midpoint_sums.hpp"
#include "assembly/pair_integrals.hpp"
#include "assembly/patch_rows.hpp"
#include "assembly/static_sums.hpp"

namespace bem {

/// Integrates two patches by the midpoints of both, those that are left out excepted
/// (midpoint.hpp).
template <class T>
class MidpointPatches {
 public:
  /// Adds what x has with y to rows places[k] of `to`, for the wanted rows k: to G all of it, to H
  /// `h_part` of it, which may be zero.
  void add(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
           const SurfacePatch& y, const LaneTable<T>& table, double h_part,
           const std::vector<int>& places, BlockSums<T>& to);

 private:
  /// The surface curls of both ends meet in sums over the axes of both: by the axis of x, 1/r and
  /// h h^T/r with the same axis of y, then 1/r with the two others.
  static constexpr std::size_t kForms = 12;

  void evaluate(const PairIntegrals& pairs, const Midpoint& x, const SurfacePatch& y,
                const LaneTable<T>& table, std::size_t lanes, bool with_h, T* strain);
  void combine_curls(const SurfacePatch& y, std::size_t x);
  void add_static_h(const Material& material, const PatchRows& wanted, double h_part,
                    const std::vector<int>& places, BlockSums<T>& to);

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
