#pragma once

#include "assembly/surface_patch.hpp"
#include "base/aligned.hpp"
#include "base/types.hpp"
#include "kernels/hypersingular_functions.hpp"
#include "kernels/radial_table.hpp"

#include <algorithm>

namespace bem {

/// Points of the product of two flat triangles in fibres: runs of points of which one of the two
/// stays, so that sums over the other one come first and have few terms. Arrays are separate;
/// unused entries up to the next multiple of kPadding repeat a point with weight zero.
struct PairBatch {
  static constexpr int kCapacity = 64, kFibres = 16;  ///< points, fibres
  static constexpr int kLongestFibre = 16;
  static constexpr int kPadding = 16;
  static constexpr int kRows = 7;  ///< one, and the six shape functions

  bool x_stays = true;  ///< in all fibres; else y does
  int size = 0, fibres = 0;
  int begin[kFibres + 1] = {};      ///< of fibres
  double r[3][kCapacity];           ///< y - x [m]
  double moving[kRows][kCapacity];  ///< at the end that moves, times the weight of the point [m^4]
  double staying[kRows][kFibres];   ///< at the end that stays

  int padded_size() const { return (size + kPadding - 1) / kPadding * kPadding; }
  void pad();
  void clear() { size = fibres = 0; }
};

/// Cuts a stream of points into fibres and those into batches, which it gives to `consume`.
template <class Consume>
class FibreCollector {
 public:
  FibreCollector(PairBatch& batch, const Consume& consume) : batch_(batch), consume_(consume) {
    batch.clear();
  }

  /// r = y - x, and barycentric coordinates of both.
  void add(const Vec3& r, const double* x, const double* y, double weight) {
    if (size_ > 0) {
      const Point& first = run_[0];
      const bool same_x = std::equal(x, x + 3, first.x), same_y = std::equal(y, y + 3, first.y);
      const bool goes_on = size_ < PairBatch::kLongestFibre && (size_ == 1 ? same_x || same_y
                                                                : x_stays_ ? same_x
                                                                           : same_y);
      if (!goes_on) store();
      if (size_ == 1) x_stays_ = same_x;
    }
    Point& p = run_[size_++];
    p.r = r;
    p.weight = weight;
    std::copy_n(x, 3, p.x);
    std::copy_n(y, 3, p.y);
  }

  void finish() {
    if (size_ > 0) store();
    flush();
  }

 private:
  struct Point {
    Vec3 r;
    double x[3], y[3], weight;
  };

  void store() {
    const bool x_stays = size_ == 1 || x_stays_;
    const bool room = batch_.fibres < PairBatch::kFibres &&
                      batch_.size + size_ <= PairBatch::kCapacity && batch_.x_stays == x_stays;
    if (!room) flush();
    batch_.x_stays = x_stays;
    set_row(x_stays ? run_[0].x : run_[0].y, 1, &batch_.staying[0][batch_.fibres],
            PairBatch::kFibres);
    batch_.begin[batch_.fibres++] = batch_.size;
    for (int i = 0; i < size_; ++i) {
      const Point& p = run_[i];
      const int q = batch_.size++;
      for (int k = 0; k < 3; ++k) batch_.r[k][q] = p.r[k];
      set_row(x_stays ? p.y : p.x, p.weight, &batch_.moving[0][q], PairBatch::kCapacity);
    }
    batch_.begin[batch_.fibres] = batch_.size;
    size_ = 0;
  }

  static void set_row(const double* barycentric, double weight, double* to, int stride) {
    const auto shapes = quadratic_shapes(barycentric);
    to[0] = weight;
    for (int a = 0; a < 6; ++a) to[(a + 1) * stride] = weight * shapes[a];
  }

  void flush() {
    if (batch_.size == 0) return;
    batch_.pad();
    consume_(static_cast<const PairBatch&>(batch_));
    batch_.clear();
  }

  PairBatch& batch_;
  const Consume& consume_;
  Point run_[PairBatch::kLongestFibre];
  int size_ = 0;
  bool x_stays_ = true;
};

/// Where the sums over the points of a pair of triangles go, for every lane (lag and stage
/// component): the dynamic kernels times the shape functions of both triangles. Arrays are
/// [entry][padded lane].
template <class T>
struct PairSums {
  static constexpr int kShapes = 6;
  static constexpr int kUniform = 12;

  T* inertia[kShapes][kShapes];  ///< Z by shapes of y and x, 9 entries; all null: not wanted
  T* adjoint[3][kShapes];        ///< J by corners of y and shapes of x, 9 entries (row-major)
  /// J of tractions that are constant on y, by shapes of x: 9 entries, then pressure_kernel(): 3.
  T* uniform[kShapes];
};

/// Points y that are seen from one point x, each with a normal of its own.
struct MidpointBatch {
  static constexpr int kCapacity = PairBatch::kCapacity;

  int size = 0;
  double r[3][kCapacity];  ///< y - x [m]
  double n[3][kCapacity];  ///< normals at y times areas [m^2]
  double area[kCapacity];  ///< of y [m^2]

  /// Entries up to here have to be filled with something.
  int padded_size() const {
    return (size + PairBatch::kPadding - 1) / PairBatch::kPadding * PairBatch::kPadding;
  }
};

/// Where the kernels of one x and many y go; normals at both ends times their areas. Arrays end in
/// [padded lane].
template <class T>
struct MidpointSums {
  static constexpr int kUniform = 30;

  T* inertia;  ///< Z: [y][9 entries]; null: not wanted
  T* adjoint;  ///< J times the area of y: [y][9 entries]
  T* uniform;  ///< sums over y: J_il n_k at 9 i + 3 l + k, then pressure_kernel(): 3
};

/// What kernels of points of two surfaces have in common.
struct PairScales {
  double density;  ///< [kg/m^3]
  double kappa;
  double lam_per_distance;  ///< 1/(c2 dt) [1/m]
};

/// Working memory of one thread.
template <class T>
struct PairScratch {
  static constexpr int kCoefficients = 75;  // of the radial functions in the tensors
  static constexpr int kFibreSums = 126;    // products of tensor entries and shapes that move
  static constexpr int kLanes = 64 / sizeof(T);
  static constexpr int kStride = PairBatch::kCapacity + kLanes;
  alignas(64) T coefficient[kCoefficients][kStride];
  alignas(64) T moving[PairBatch::kRows][kStride];
  alignas(64) T staying[PairBatch::kRows][PairBatch::kFibres];
  alignas(64) T local[PairBatch::kCapacity];
  const T* interval[PairBatch::kCapacity];
  alignas(64) T radial[kHypersingularCount * PairBatch::kLongestFibre * kLanes];
  alignas(64) T fibre_sums[kFibreSums * PairBatch::kFibres * kLanes];
};

/// Adds the contribution of a batch of points; `table` is of hypersingular_family(), m and n are
/// the unit normals at x and y. Runs on the widest vector unit of the machine.
void accumulate_pair(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums);
void accumulate_pair(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums);

/// The same in plain scalar code, for tests.
void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const Vec3& m, const Vec3& n, const PairBatch& batch,
                               const PairSums<double>& sums);

/// Stores the kernels between a point x, whose normal times its area is m, and others.
void evaluate_midpoints(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<double>& scratch,
                        const MidpointSums<double>& sums);
void evaluate_midpoints(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<float>& scratch,
                        const MidpointSums<float>& sums);

/// to[row] = sum of value from[item] over the entries of the row, for `size` numbers each, a
/// multiple of LaneTable<T>::kLanePadding.
void combine_rows(const SparseRows& rows, const double* from, std::size_t size, double* to);
void combine_rows(const SparseRows& rows, const float* from, std::size_t size, float* to);

/// out[3 axes x 6][padded lane] += J of tractions that are constant on y: `tractions` (3 x 6), and
/// `pressure` times the pressure kernel, from PairSums::uniform of a shape of x.
void add_strain(const double* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, double* out);
void add_strain(const float* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out);

}  // namespace bem
