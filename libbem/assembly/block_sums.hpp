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
  /// Adds the rows of another patch to rows places[k]; its nodes and hats are these ones here.
  void add(const BlockSums& part, const std::vector<int>& places, const std::vector<int>& of_nodes,
           const std::vector<int>& of_hats) {
    scatter(part.inertia, places, of_nodes, 9 * lanes, nodes, inertia);
    scatter(part.static_h, places, of_nodes, kStaticEntry, nodes, static_h);
    scatter(part.adjoint, places, of_hats, 9 * lanes, hats, adjoint);
    scatter(part.static_g, places, of_hats, kStaticEntry, hats, static_g);
    scatter(part.strain, places, {0}, 18 * lanes, 1, strain);
  }

 private:
  /// to[places[k]][columns[i]] += from[k][i], `size` numbers each; `to` has `width` columns.
  template <class S>
  static void scatter(const AlignedVector<S>& from, const std::vector<int>& places,
                      const std::vector<int>& columns, std::size_t size, std::size_t width,
                      AlignedVector<S>& to) {
    const S* a = from.data();
    for (int row : places)
      for (int column : columns) {
        S* b = &to[(row * width + column) * size];
        for (std::size_t i = 0; i < size; ++i) b[i] += *a++;
      }
  }
};

}  // namespace bem
