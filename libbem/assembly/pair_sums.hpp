#pragma once

#include "assembly/pair_batch.hpp"
#include "kernels/radial_table.hpp"

namespace bem {

/// Where the sums over the points of a pair of triangles go, for every lane (lag and stage
/// component): the dynamic kernels times the shape functions of both triangles. Arrays are
/// [entry][lane].
template <class T>
struct PairSums {
  static constexpr int kUniform = 12;

  std::size_t
      lanes;  ///< that are stored: a multiple of LaneTable::kLanePadding; later ones are zero
  T* inertia[kShapes][kShapes];  ///< Z by shapes of y and x, 9 entries; all null: not wanted
  T* adjoint[3][kShapes];        ///< J by corners of y and shapes of x, 9 entries (row-major)
  /// J of tractions that are constant on y, by shapes of x: 9 entries, then pressure_kernel(): 3.
  T* uniform[kShapes];
};

/// Adds the contribution of a batch of points; `table` is of hypersingular_family(), m and n are
/// the unit normals at x and y. Runs on the widest vector unit of the machine.
void accumulate_pair(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums);
void accumulate_pair(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums);

}  // namespace bem
