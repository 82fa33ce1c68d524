// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/midpoint_sums.cpp"
#include "assembly/midpoint_sums.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format off: after foreach_target.h
#include "assembly/pair_kernels-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One vector of lanes of MidpointSums.
template <bool with_inertia, class D, class T = hn::TFromD<D>>
HWY_INLINE void EvaluateMidpointLanes(D d, std::size_t lane, const LaneTable<T>& table, int size,
                                      PairScratch<T>& scratch, const MidpointSums<T>& sums) {
  using V = hn::Vec<D>;
  const std::size_t stride = sums.lanes;
  V pressure[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int q = 0; q < size; ++q) {
    V f[kHypersingularCount];
    EvaluateRadial<kFirstFunction<with_inertia>>(d, table.padded_lanes, scratch.interval[q] + lane,
                                                 scratch.local[q], f);
    const auto at = [&](int row) { return hn::Set(d, scratch.coefficient[row][q]); };
    T* HWY_RESTRICT adjoint = sums.adjoint + 9 * q * stride + lane;
    const V area = hn::Set(d, scratch.moving[0][q]);
    const V p = hn::Mul(area, f[kDynamicP]), s = hn::Mul(area, f[kDynamicS]),
            t = hn::Mul(area, f[kDynamicQ]);
#pragma GCC unroll 9
    for (int e = 0; e < 9; ++e) {
      if constexpr (with_inertia) {
        V z = hn::Mul(at(kOfAlpha + e), f[kAlpha]);
        z = hn::MulAdd(at(kOfBeta + e), f[kBeta], z);
        z = hn::MulAdd(at(kOfGamma + e), f[kGamma], z);
        z = hn::MulAdd(at(kOfDelta + e), f[kDelta], z);
        z = hn::MulAdd(at(kOfEpsilon + e), f[kEpsilon], z);
        hn::StoreU(z, d, sums.inertia + (9 * q + e) * stride + lane);
      }
      V j = hn::Mul(at(kOfP + e), p);
      j = hn::MulAdd(at(kOfQ + e), t, j);
      j = hn::MulAdd(at(kOfS + e), s, j);
      hn::StoreU(j, d, adjoint + e * stride);
    }
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const V here = hn::Mul(at(kOfDilation + i), f[kDilation]);
      pressure[i] = hn::Add(pressure[i], here);
      if (sums.pressure) hn::StoreU(here, d, sums.pressure + (3 * q + i) * stride + lane);
    }
  }
  for (int i = 0; i < 3; ++i) hn::StoreU(pressure[i], d, sums.uniform + (27 + i) * stride + lane);
  for (int i = 0; i < 3; ++i) {
    V sum[9];
#pragma GCC unroll 9
    for (V& v : sum) v = hn::Zero(d);
    for (int q = 0; q < size; ++q) {
      const T* HWY_RESTRICT adjoint = sums.adjoint + (9 * q + 3 * i) * stride + lane;
#pragma GCC unroll 3
      for (int l = 0; l < 3; ++l) {
        const V j = hn::LoadU(d, adjoint + l * stride);
#pragma GCC unroll 3
        for (int k = 0; k < 3; ++k)
          sum[3 * l + k] = hn::MulAdd(j, hn::Set(d, scratch.moving[1 + k][q]), sum[3 * l + k]);
      }
    }
#pragma GCC unroll 9
    for (int k = 0; k < 9; ++k) hn::StoreU(sum[k], d, sums.uniform + (9 * i + k) * stride + lane);
  }
}

template <class T>
void EvaluateMidpoints(const LaneTable<T>& table, const PairScales& scales, const Vec3& m,
                       const MidpointBatch& batch, PairScratch<T>& scratch,
                       const MidpointSums<T>& sums) {
  const auto normal = [&batch](auto d, int axis, int q) {
    return LoadPoints(d, batch.n[axis] + q);
  };
  PairCoefficients(table, scales, m, batch.r, normal, batch.padded_size(), scratch);
  for (int q = 0; q < batch.size; ++q) {
    scratch.moving[0][q] = static_cast<T>(batch.area[q]);
    for (int k = 0; k < 3; ++k)
      scratch.moving[1 + k][q] = static_cast<T>(batch.n[k][q] / batch.area[q]);
  }
  ForLanes<T>(sums.lanes, [&](auto d, std::size_t lane) {
    if (sums.inertia)
      EvaluateMidpointLanes<true>(d, lane, table, batch.size, scratch, sums);
    else
      EvaluateMidpointLanes<false>(d, lane, table, batch.size, scratch, sums);
  });
}

void EvaluateMidpointsDouble(const LaneTable<double>& table, const PairScales& scales,
                             const Vec3& m, const MidpointBatch& batch,
                             PairScratch<double>& scratch, const MidpointSums<double>& sums) {
  EvaluateMidpoints(table, scales, m, batch, scratch, sums);
}
void EvaluateMidpointsFloat(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                            const MidpointBatch& batch, PairScratch<float>& scratch,
                            const MidpointSums<float>& sums) {
  EvaluateMidpoints(table, scales, m, batch, scratch, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(EvaluateMidpointsDouble);
HWY_EXPORT(EvaluateMidpointsFloat);

void evaluate_midpoints(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<double>& scratch,
                        const MidpointSums<double>& sums) {
  HWY_DYNAMIC_DISPATCH(EvaluateMidpointsDouble)(table, scales, m, batch, scratch, sums);
}

void evaluate_midpoints(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<float>& scratch,
                        const MidpointSums<float>& sums) {
  HWY_DYNAMIC_DISPATCH(EvaluateMidpointsFloat)(table, scales, m, batch, scratch, sums);
}

}  // namespace bem
#endif
