#pragma once

#include "assembly/pair_batch.hpp"
#include "assembly/surface_patch.hpp"
#include "kernels/radial_table.hpp"

namespace bem {

/// Points y that are seen from one point x, each with a normal of its own.
struct MidpointBatch {
  static constexpr int kCapacity = PairBatch::kCapacity;

  int size = 0;
  double r[3][kCapacity];  ///< y - x [m]
  double n[3][kCapacity];  ///< normals at y times areas [m^2]
  double area[kCapacity];  ///< of y [m^2]

  /// `count` points, midpoint(q) for each, as they are seen from x.
  template <class At>
  void set(const Vec3& x, int count, const At& midpoint) {
    size = count;
    for (int q = 0; q < padded_size(); ++q) {
      const Midpoint& p = midpoint(q < size ? q : 0);
      for (int k = 0; k < 3; ++k) {
        r[k][q] = p.place[k] - x[k];
        n[k][q] = p.normal[k];
      }
      area[q] = p.area;
    }
  }
  /// Entries up to here have to be filled with something.
  int padded_size() const {
    return (size + PairBatch::kPadding - 1) / PairBatch::kPadding * PairBatch::kPadding;
  }
};

/// f(first) for the points y from `first` on that the batch holds, batch by batch.
template <class F>
void for_each_batch(const Vec3& x, const std::vector<Midpoint>& y, MidpointBatch& batch,
                    const F& f) {
  for (std::size_t first = 0; first < y.size(); first += MidpointBatch::kCapacity) {
    batch.set(x, static_cast<int>(std::min<std::size_t>(y.size() - first, batch.kCapacity)),
              [&](int q) -> const Midpoint& { return y[first + static_cast<std::size_t>(q)]; });
    f(first);
  }
}

/// Where the kernels of one x and many y go; normals at both ends times their areas. Arrays end in
/// [lane].
template <class T>
struct MidpointSums {
  static constexpr int kUniform = 30;

  std::size_t lanes;      ///< that are stored: a multiple of LaneTable::kLanePadding
  T* inertia;             ///< Z: [y][9 entries]; null: not wanted
  T* adjoint;             ///< J times the area of y: [y][9 entries]
  T* uniform;             ///< sums over y: J_il n_k at 9 i + 3 l + k, then pressure_kernel(): 3
  T* pressure = nullptr;  ///< pressure_kernel() alone: [y][3]; null: not wanted
};

/// Stores the kernels between a point x, whose normal times its area is m, and others.
void evaluate_midpoints(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<double>& scratch,
                        const MidpointSums<double>& sums);
void evaluate_midpoints(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<float>& scratch,
                        const MidpointSums<float>& sums);

}  // namespace bem
