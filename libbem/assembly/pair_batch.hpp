#pragma once

#include "assembly/edge_reconstruction.hpp"
#include "base/aligned.hpp"
#include "base/types.hpp"
#include "kernels/hypersingular_functions.hpp"

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
    for (int a = 0; a < kShapes; ++a) to[(a + 1) * stride] = weight * shapes[a];
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
  std::size_t used_lanes;  ///< of the points: LaneTable::used_lanes
  alignas(64) T radial[kHypersingularCount * PairBatch::kLongestFibre * kLanes];
  alignas(64) T fibre_sums[kFibreSums * PairBatch::kFibres * kLanes];
};

}  // namespace bem
