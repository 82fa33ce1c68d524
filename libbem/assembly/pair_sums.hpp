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

/// Where the sums over the points of a pair of triangles go, for every lane (lag and stage
/// component): the dynamic kernels times the shape functions of both triangles. Arrays are
/// [entry][shape of x][padded lane].
template <class T>
struct PairSums {
  static constexpr int kShapes = 6;  ///< of x
  static constexpr int kUniform = 12;

  T* inertia[6];  ///< Z by shape of y, 9 entries (row-major); all null: not wanted
  T* adjoint[3];  ///< J by corner of y, 9 entries
  T* uniform;     ///< J of tractions that are constant on y: 9 entries, then pressure_kernel(): 3
};

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

/// Adds the contribution of a batch of points; `table` is of hypersingular_family(). Runs on the
/// widest vector unit of the machine.
void accumulate_pair(const LaneTable<double>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums);
void accumulate_pair(const LaneTable<float>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums);

/// The same in plain scalar code, for tests.
void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const PairBatch& batch, const PairSums<double>& sums);

/// to[i] += factor * from[i]; `size` is a multiple of LaneTable<T>::kLanePadding.
void add_scaled(double factor, const double* from, double* to, std::size_t size);
void add_scaled(float factor, const float* from, float* to, std::size_t size);

/// to[entry][padded lane] += sum over the shapes of x of weights[shape] from[entry][shape][lane].
void combine_shapes(const double* weights, const double* from, int entries, int padded_lanes,
                    double* to);
void combine_shapes(const float* weights, const float* from, int entries, int padded_lanes,
                    float* to);

/// out[shape of x][3 axes x 6][padded lane] += J of tractions that are constant on y: `tractions`
/// (3 x 6), and `pressure` times the pressure kernel, from PairSums::uniform.
void add_strain(const double* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, double* out);
void add_strain(const float* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out);

}  // namespace bem
