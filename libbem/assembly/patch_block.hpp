#pragma once

#include "assembly/midpoint_patches.hpp"
#include "assembly/shape_patches.hpp"

#include <algorithm>
#include <numeric>

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
  /// Adds what a patch x has with y, which has these parts. Kernels that y is too close for go on
  /// to its parts, where they are integrated by midpoints or by shape functions.
  void add(const PatchPair& pair, const PatchParts& parts, const LaneTable<T>& table) {
    places_.clear();
    for (int row : pair.rows.rows) places_.push_back(place_[row]);
    const bool dynamic = pair.is_far(KernelPart::dynamic_part),
               fixed = pair.is_far(KernelPart::static_part);
    if (dynamic) midpoints_.add_dynamic(pair, table, places_, sums_);
    if (fixed) midpoints_.add_static(pair, places_, sums_);
    if (dynamic && fixed) return;
    own_places_.resize(places_.size());
    std::iota(own_places_.begin(), own_places_.end(), 0);
    for (const PatchParts::Part& part : parts.parts) {
      const PatchPair of_part = {pair.integrals, pair.x, pair.rows, part.patch, pair.h_part};
      part_.start(places_.size(), part.patch, sums_.lanes);
      if (!dynamic) add_dynamic(of_part, table);
      if (!fixed) add_static(of_part);
      sums_.add(part_, places_, part.nodes, part.hats);
    }
  }

  /// Which row of the sums is of this row; -1: none.
  int place(int row) const { return place_[row]; }
  const BlockSums<T>& sums() const { return sums_; }

 private:
  void add_dynamic(const PatchPair& pair, const LaneTable<T>& table) {
    if (pair.is_far(KernelPart::dynamic_part))
      midpoints_.add_dynamic(pair, table, own_places_, part_);
    else
      shapes_.add_dynamic(pair, table, own_places_, part_);
  }
  void add_static(const PatchPair& pair) {
    if (pair.is_far(KernelPart::static_part))
      midpoints_.add_static(pair, own_places_, part_);
    else
      shapes_.add_static(pair, own_places_, part_);
  }

  std::vector<int> place_;                ///< by row
  std::vector<int> places_, own_places_;  ///< of the rows of one patch of x, in sums_ and in part_
  BlockSums<T> sums_, part_;
  MidpointPatches<T> midpoints_;
  ShapePatches<T> shapes_;
};

}  // namespace bem
