#pragma once

#include "assembly/close_patches.hpp"
#include "assembly/midpoint_patches.hpp"

#include <algorithm>

namespace bem {

/// What one patch of y adds to wanted rows of the matrices (GalerkinRows), those that patches x
/// reach, and working memory for it.
template <class T>
class PatchBlock {
 public:
  /// Starts with zeros in those of `count` rows for which `reaches` holds and that a patch has.
  /// `lanes`: see BlockSums.
  template <class Reaches>
  void start(int count, const std::vector<PatchRows>& wanted, const Reaches& reaches,
             const SurfacePatch& y, std::size_t lanes) {
    place_.assign(count, -1);
    std::size_t rows = 0;
    std::vector<char> reached(count, 0);
    for (const PatchRows& x : wanted)
      if (std::any_of(x.rows.begin(), x.rows.end(), reaches))
        for (int row : x.rows) reached[row] = 1;
    for (int row = 0; row < count; ++row)
      if (reached[row] != 0) place_[row] = static_cast<int>(rows++);
    sums_.start(rows, y, lanes);
  }
  /// Adds what the patch x has with y, which has these parts: to G all of it, to H `h_part` of it,
  /// which may be zero.
  void add(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
           const SurfacePatch& y, const PatchParts& parts, const LaneTable<T>& table,
           double h_part) {
    places_.clear();
    for (int row : wanted.rows) places_.push_back(place_[row]);
    midpoints_.add(pairs, x, wanted, y, table, h_part, places_, sums_);
    for (const PatchParts::Part& part : parts.parts)
      close_.add(pairs, x, wanted, part, table, h_part, places_, sums_);
  }

  /// Which row of the sums is of this row; -1: none.
  int place(int row) const { return place_[row]; }
  const BlockSums<T>& sums() const { return sums_; }

 private:
  std::vector<int> place_;   ///< by row
  std::vector<int> places_;  ///< of the rows of one patch of x
  BlockSums<T> sums_;
  MidpointPatches<T> midpoints_;
  ClosePatches<T> close_;
};

}  // namespace bem
