#pragma once

#include "base/aligned.hpp"
#include "base/types.hpp"
#include "kernels/hypersingular_functions.hpp"
#include "kernels/radial_table.hpp"

namespace bem {

/// Up to kCapacity points of the product of two flat triangles as separate arrays. Unused entries
/// up to the next multiple of kPadding repeat a point with weight zero.
struct PairBatch {
  static constexpr int kCapacity = 32;
  static constexpr int kPadding = 16;

  int size = 0;
  double r[3][kCapacity];        ///< y - x [m]
  double x_shape[6][kCapacity];  ///< shape functions at x times the weight of the point [m^4]
  double y_shape[6][kCapacity];  ///< shape functions at y

  int padded_size() const { return (size + kPadding - 1) / kPadding * kPadding; }
  void pad();
};

/// What is summed over the points of a pair of triangles, for every lane (lag and stage component):
/// the dynamic kernels times the shape functions of both triangles.
enum PairSum : int {
  kSumInertia = 0,                   ///< Z: [3x3 entry, row-major][shape of y][shape of x]
  kSumAdjoint = kSumInertia + 324,   ///< J: [3x3 entry][linear shape of y][shape of x]
  kSumPressure = kSumAdjoint + 162,  ///< pressure_kernel(): [axis][shape of x]
  kPairSums = kSumPressure + 18
};
constexpr int inertia_sum(int entry, int y, int x) {
  return kSumInertia + 36 * entry + 6 * y + x;
}
constexpr int adjoint_sum(int entry, int y, int x) {
  return kSumAdjoint + 18 * entry + 6 * y + x;
}

/// What the kernels of a pair have in common.
struct PairScales {
  double density;  ///< [kg/m^3]
  double kappa;
  double lam_per_distance;  ///< 1/(c2 dt) [1/m]
  Vec3 m, n;                ///< outward unit normals at x and y
};

/// Working memory of one thread.
template <class T>
struct PairScratch {
  static constexpr int kTensors = 21;       // entries of Z and J, and of the pressure kernel
  static constexpr int kCoefficients = 75;  // of the radial functions in them
  static constexpr int kStride = PairBatch::kCapacity + 64 / sizeof(T);
  alignas(64) T coefficient[kCoefficients][kStride];
  alignas(64) T weight[36][kStride];  ///< products of shape functions, [y][x]
  alignas(64) T x_weight[6][kStride];
  alignas(64) T local[PairBatch::kCapacity];
  const T* interval[PairBatch::kCapacity];
  alignas(64) T values[kTensors * PairBatch::kCapacity * (64 / sizeof(T))];
};

/// sums[PairSum][padded lane] += the contribution of a batch of points; `table` is of
/// hypersingular_family(). Runs on the widest vector unit of the machine.
void accumulate_pair(const LaneTable<double>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<double>& scratch, double* sums);
void accumulate_pair(const LaneTable<float>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<float>& scratch, float* sums);

/// Where the sums of a pair go: combinations of the shape functions of both triangles, which are
/// rows and columns of blocks [row][column][3x3 entry][padded lane].
template <class T>
struct PairTarget {
  int rows, columns;
  const T* row_weights;     ///< [rows][6]
  const T* column_weights;  ///< [columns][6]
  const int* row_slots;     ///< by row: its place in the blocks
  const int* column_slots;
  const int* corner_slots;  ///< of the three corners of y, which tractions belong to
  std::size_t block_columns;
  T* inertia;
  T* adjoint;
};

/// Adds Z and J of a pair to their targets.
void add_pair(const double* sums, int padded_lanes, const PairTarget<double>& target);
void add_pair(const float* sums, int padded_lanes, const PairTarget<float>& target);

/// out[shape of x][3 axes x 6][padded lane] += J of tractions that are constant on y: `tractions`
/// (3 x 6), and `pressure` times the sums of the pressure kernel.
void add_pair_strain(const double* sums, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     double* out);
void add_pair_strain(const float* sums, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     float* out);

/// The sums in plain scalar code, for tests.
void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const PairBatch& batch, double* sums);

}  // namespace bem
