#pragma once

#include "assembly/galerkin_rows.hpp"
#include "assembly/midpoint_sums.hpp"
#include "assembly/pair_integrals.hpp"
#include "assembly/surface_patch.hpp"

#include <algorithm>

namespace bem {

/// to[rows[k]] += from[k], for `size` numbers each.
template <class T>
void add_rows(const std::vector<int>& rows, const T* from, std::size_t size, T* to) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const T* a = from + k * size;
    T* b = to + rows[k] * size;
    for (std::size_t i = 0; i < size; ++i) b[i] += a[i];
  }
}

/// A 3 x 3 block of numbers that are stored entry by entry.
using Entries = std::array<Eigen::MatrixXd, 9>;

/// Rows of a patch of x that are wanted: nodes [first, last).
struct PatchRows {
  std::vector<int> rows;  ///< counted from the first wanted row, ascending
  SparseRows shapes, midpoints;
  Eigen::MatrixXd dense_shapes, dense_midpoints;
  std::array<Eigen::MatrixXd, 3> curls_at;  ///< of SurfacePatch, wanted rows alone

  PatchRows(const SurfacePatch& patch, int first, int last);
};

/// What one patch of y adds to wanted rows of the matrices (GalerkinRows), those that patches x
/// reach, and working memory for it.
template <class T>
class PatchBlock {
 public:
  AlignedVector<T> inertia, adjoint;  ///< [place][node or hat of y][3x3 entry][padded lane]
  AlignedVector<T> strain;            ///< [place][3 axes x 6][padded lane]
  Entries static_h, static_g;         ///< places x nodes or hats of y

  /// Starts with zeros in those of `count` rows for which `reaches` holds and that a patch has.
  template <class Reaches>
  void start(int count, const std::vector<PatchRows>& wanted, const Reaches& reaches,
             const SurfacePatch& y, int padded_lanes) {
    place_.assign(count, -1);
    int rows = 0;
    std::vector<char> reached(count, 0);
    for (const PatchRows& x : wanted)
      if (std::any_of(x.rows.begin(), x.rows.end(), reaches))
        for (int row : x.rows) reached[row] = 1;
    for (int row = 0; row < count; ++row)
      if (reached[row] != 0) place_[row] = rows++;
    clear(rows, y, padded_lanes);
  }
  /// Where a row is, or -1.
  int place(int row) const { return place_[row]; }
  /// Adds what the patch x has with y: to G all of it, to H `h_part` of it, which may be zero.
  void add(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
           const SurfacePatch& y, const LaneTable<T>& lanes, double h_part);

 private:
  void clear(int rows, const SurfacePatch& y, int padded_lanes);
  void add_dynamic(const PairIntegrals& pairs, const SurfacePatch& x, const PatchRows& wanted,
                   const SurfacePatch& y, const LaneTable<T>& lanes, double h_part, bool far);
  void sum_by_shapes(const PairIntegrals& pairs, const SurfacePatch& x, const SurfacePatch& y,
                     const LaneTable<T>& lanes, bool with_h);
  void sum_by_midpoints(const PairIntegrals& pairs, const SurfacePatch& x, const SurfacePatch& y,
                        const LaneTable<T>& lanes, bool with_h);
  void add_static_by_shapes(const PairIntegrals& pairs, const SurfacePatch& x,
                            const PatchRows& wanted, const SurfacePatch& y, double h_part);
  void add_static_by_midpoints(const PairIntegrals& pairs, const SurfacePatch& x,
                               const PatchRows& wanted, const SurfacePatch& y, double h_part);

  std::vector<int> place_;   ///< by row
  std::vector<int> places_;  ///< of the rows of one patch of x
  /// Of one patch of x alone, by its rows.
  AlignedVector<T> some_rows_;
  /// The same by shapes or midpoints of x and y, and inertia by shapes of x and nodes of y.
  AlignedVector<T> own_inertia_, own_adjoint_, own_strain_, by_node_;
  Entries own_static_h_, own_static_g_;
  Eigen::MatrixXd forms_, static_tractions_, static_by_y_, static_sum_;
  AlignedVector<T> uniform_;
  PairBatch pair_batch_;
  MidpointBatch midpoint_batch_;
  PairScratch<T> scratch_;
  Eigen::MatrixXd of_y_;  ///< displacements: shapes x nodes of y
  /// At midpoints: tractions, midpoints x hats of y; curls, midpoints x nodes of y by axis.
  Eigen::MatrixXd tractions_of_y_, curls_of_y_;
};

}  // namespace bem
