// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/static_sums.cpp"
#include "assembly/static_sums.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The static kernels at all points, lanes over points: values[kernel][point].
HWY_ATTR void EvaluateStatic(const Vec3& m, const StaticTraction& f, const StaticBatch& batch,
                             double (*HWY_RESTRICT values)[StaticBatch::kCapacity]) {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  const V normal[3] = {hn::Set(d, m[0]), hn::Set(d, m[1]), hn::Set(d, m[2])};
  const V p = hn::Set(d, f.p), q = hn::Set(d, f.q), s = hn::Set(d, f.s),
          scale = hn::Set(d, -1 / (4 * kPi)), one = hn::Set(d, 1.0);
  for (int i = 0; i < batch.size; i += static_cast<int>(hn::Lanes(d))) {
    const V x = hn::LoadU(d, batch.r[0] + i), y = hn::LoadU(d, batch.r[1] + i),
            z = hn::LoadU(d, batch.r[2] + i);
    const V inverse = hn::Div(one, hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)))));
    const V h[3] = {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
    const V hm = hn::MulAdd(h[0], normal[0], hn::MulAdd(h[1], normal[1], hn::Mul(h[2], normal[2])));
    const V k = hn::Mul(scale, hn::Mul(inverse, inverse));
    const V kp = hn::Mul(k, p), kq = hn::Mul(k, q), ks = hn::Mul(hn::Mul(k, s), hm);
    const V diagonal = hn::Mul(kp, hm);
    const auto store = [&](int row, V value) { hn::Store(value, d, values[row] + i); };
    int entry = StaticSums::kTensor;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        V value = hn::Mul(kp, hn::Mul(h[r], normal[c]));
        value = hn::MulAdd(kq, hn::Mul(normal[r], h[c]), value);
        value = hn::MulAdd(ks, hn::Mul(h[r], h[c]), value);
        store(StaticSums::kAdjoint + 3 * r + c, r == c ? hn::Add(value, diagonal) : value);
        if (c >= r) store(entry++, hn::Mul(inverse, hn::Mul(h[r], h[c])));
      }
    store(StaticSums::kScalar, inverse);
  }
}

HWY_ATTR void AccumulateStatic(const Vec3& m, const StaticTraction& traction,
                               const StaticBatch& batch, StaticSums& sums) {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int kTogether = 8;
  alignas(64) double values[StaticSums::kCount][StaticBatch::kCapacity];
  EvaluateStatic(m, traction, batch, values);
  for (int first = 0; first < StaticSums::kCount; first += kTogether)
    for (int shape = 0; shape < StaticBatch::kShapes; shape += static_cast<int>(hn::Lanes(d))) {
      V sum[kTogether];
#pragma GCC unroll 8
      for (int k = 0; k < kTogether; ++k) sum[k] = hn::Load(d, sums.values[first + k] + shape);
      for (int i = 0; i < batch.size; ++i) {
        const V weight = hn::Load(d, batch.shapes[i] + shape);
#pragma GCC unroll 8
        for (int k = 0; k < kTogether; ++k)
          sum[k] = hn::MulAdd(hn::Set(d, values[first + k][i]), weight, sum[k]);
      }
#pragma GCC unroll 8
      for (int k = 0; k < kTogether; ++k) hn::Store(sum[k], d, sums.values[first + k] + shape);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "assembly/edge_reconstruction.hpp"

#include <algorithm>

namespace bem {

HWY_EXPORT(AccumulateStatic);
HWY_EXPORT(EvaluateStatic);

void set_shapes(const double* x, const double* y, double weight,
                double (&shapes)[StaticBatch::kShapes]) {
  const auto of_x = quadratic_shapes(x);
  std::fill(std::begin(shapes), std::end(shapes), 0.0);
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 3; ++b) shapes[3 * a + b] = weight * of_x[a] * y[b];
}

namespace {

/// Whole vectors: what is computed of points that do not exist has to be finite only.
void pad(StaticBatch& batch) {
  for (int i = batch.size; i % 8 != 0; ++i)
    for (auto& component : batch.r) component[i] = 1;
}

}  // namespace

void evaluate_static(const Vec3& m, const StaticTraction& traction, StaticBatch& batch,
                     double (*values)[StaticBatch::kCapacity]) {
  pad(batch);
  HWY_DYNAMIC_DISPATCH(EvaluateStatic)(m, traction, batch, values);
}

void accumulate_static(const Vec3& m, const StaticTraction& traction, StaticBatch& batch,
                       StaticSums& sums) {
  pad(batch);
  HWY_DYNAMIC_DISPATCH(AccumulateStatic)(m, traction, batch, sums);
}

}  // namespace bem
#endif
