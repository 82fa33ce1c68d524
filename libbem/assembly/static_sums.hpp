#pragma once

#include "kernels/hypersingular_functions.hpp"

namespace bem {

/// Up to kCapacity points of the product of two flat triangles, for the static kernels.
struct StaticBatch {
  static constexpr int kCapacity = 64;
  static constexpr int kShapes = 24;  ///< 18 that are used, up to whole vectors

  int size = 0;
  double r[3][kCapacity];  ///< y - x [m]
  /// Of each point: see set_shapes(). On a cache line; points may share their numbers with others.
  const double (*shapes)[kShapes] = nullptr;

  void add(const Vec3& distance) {
    for (int i = 0; i < 3; ++i) r[i][size] = distance[i];
    ++size;
  }
};

/// Weight times shape function a of x times linear function b of y, at 3 a + b; the rest is zero.
void set_shapes(const double* x, const double* y, double weight,
                double (&shapes)[StaticBatch::kShapes]);

/// Sums over points: static kernels times products of shape functions.
struct StaticSums {
  enum { kAdjoint = 0, kScalar = 9, kTensor = 10, kCount = 16 };
  /// [K'(0): 9 entries, row-major; 1/r; h h^T/r: xx xy xz yy yz zz][3 a + b]
  alignas(64) double values[kCount][StaticBatch::kShapes] = {};
};

/// The static kernels at the points of a batch, which needs no shapes: values[StaticSums][point].
/// `m`: the normal at x, times its area if that is wanted in K'.
void evaluate_static(const Vec3& m, const StaticTraction& traction, StaticBatch& batch,
                     double (*values)[StaticBatch::kCapacity]);

/// Adds a batch; `m`: the normal at x. Runs on the widest vector unit of the machine.
void accumulate_static(const Vec3& m, const StaticTraction& traction, StaticBatch& batch,
                       StaticSums& sums);

}  // namespace bem
