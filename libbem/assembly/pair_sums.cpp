// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/pair_sums.cpp"
#include "assembly/pair_sums.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format off: after foreach_target.h
#include "assembly/pair_kernels-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
void LoadShapes(const PairBatch& batch, PairScratch<T>& scratch) {
  const hn::CappedTag<T, PairBatch::kPadding> d;
  for (int q = 0; q < batch.padded_size(); q += static_cast<int>(hn::Lanes(d)))
    for (int a = 0; a < PairBatch::kRows; ++a)
      hn::Store(LoadPoints(d, batch.moving[a] + q), d, scratch.moving[a] + q);
  for (int a = 0; a < PairBatch::kRows; ++a)
    for (int f = 0; f < batch.fibres; ++f)
      scratch.staying[a][f] = static_cast<T>(batch.staying[a][f]);
}

/// The same at the points of a fibre: radial[function][point].
template <int first, class D, class T = hn::TFromD<D>>
HWY_INLINE void EvaluateFibre(D d, const LaneTable<T>& table, std::size_t lane, int begin, int end,
                              PairScratch<T>& scratch) {
  hn::Vec<D> f[kHypersingularCount];
  for (int q = begin; q < end; ++q) {
    EvaluateRadial<first>(d, table.padded_lanes, scratch.interval[q] + lane, scratch.local[q], f);
#pragma GCC unroll 9
    for (int k = first; k < kHypersingularCount; ++k)
      hn::Store(f[k], d,
                scratch.radial + (k * PairBatch::kLongestFibre + q - begin) * hn::Lanes(d));
  }
}

/// A tensor: how many functions it consists of, the first one's number, the row of its first
/// coefficient, and its entries.
struct Tensor {
  int functions, first_function, coefficient, entries;
};
constexpr Tensor kInertiaTensor = {5, kAlpha, kOfAlpha, 9},
                 kAdjointTensor = {3, kDynamicP, kOfP, 9},
                 kPressureTensor = {1, kDilation, kOfDilation, 3};
static_assert(kEpsilon == kAlpha + 4 && kDynamicS == kDynamicP + 2);

/// Entries of a tensor times `shapes` rows of shape functions that move, summed over a fibre:
/// out[entry][shape], a fibre apart by lanes.
template <int functions, int entries, int shapes, class D, class T = hn::TFromD<D>>
HWY_INLINE void SumFibre(D d, const Tensor& tensor, int first_entry, int first_shape, int begin,
                         int end, const PairScratch<T>& scratch, T* HWY_RESTRICT out) {
  using V = hn::Vec<D>;
  const std::size_t lanes = hn::Lanes(d);
  V sum[entries * shapes];
#pragma GCC unroll 18
  for (int i = 0; i < entries * shapes; ++i) sum[i] = hn::Zero(d);
  for (int q = begin; q < end; ++q) {
    V value[entries];
#pragma GCC unroll 5
    for (int k = 0; k < functions; ++k) {
      const V f = hn::Load(
          d, scratch.radial +
                 ((tensor.first_function + k) * PairBatch::kLongestFibre + q - begin) * lanes);
#pragma GCC unroll 3
      for (int e = 0; e < entries; ++e) {
        const V c = hn::Set(
            d, scratch.coefficient[tensor.coefficient + k * tensor.entries + first_entry + e][q]);
        value[e] = k == 0 ? hn::Mul(c, f) : hn::MulAdd(c, f, value[e]);
      }
    }
#pragma GCC unroll 6
    for (int a = 0; a < shapes; ++a) {
      const V shape = hn::Set(d, scratch.moving[first_shape + a][q]);
#pragma GCC unroll 3
      for (int e = 0; e < entries; ++e)
        sum[e * shapes + a] = hn::MulAdd(shape, value[e], sum[e * shapes + a]);
    }
  }
#pragma GCC unroll 18
  for (int i = 0; i < entries * shapes; ++i)
    hn::Store(sum[i], d, out + i * PairBatch::kFibres * lanes);
}

/// As many entries at a time as registers hold.
constexpr int kEntriesTogether = HWY_TARGET <= HWY_AVX3 ? 3 : 1;

template <int functions, int shapes, class D, class T = hn::TFromD<D>>
HWY_INLINE void SumTensor(D d, const Tensor& tensor, int first_shape, int begin, int end,
                          const PairScratch<T>& scratch, T* out) {
  for (int e = 0; e < tensor.entries; e += kEntriesTogether)
    SumFibre<functions, kEntriesTogether, shapes>(
        d, tensor, e, first_shape, begin, end, scratch,
        out + e * shapes * PairBatch::kFibres * hn::Lanes(d));
}

/// to[i][a][at] += x[a][f] sums[i][f] over fibres whose x stays, for the six shapes a of x.
template <int n, class D, class T = hn::TFromD<D>>
HWY_INLINE void SpreadOverX(D d, const T (*x)[PairBatch::kFibres], int fibres,
                            const T* const (&sums)[n], T* const* const (&to)[n], std::size_t at) {
  using V = hn::Vec<D>;
  V sum[n][6];
#pragma GCC unroll 2
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) sum[i][a] = hn::LoadU(d, to[i][a] + at);
  for (int f = 0; f < fibres; ++f) {
    V value[n];
#pragma GCC unroll 2
    for (int i = 0; i < n; ++i) value[i] = hn::Load(d, sums[i] + f * hn::Lanes(d));
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) {
      const V weight = hn::Set(d, x[a][f]);
#pragma GCC unroll 2
      for (int i = 0; i < n; ++i) sum[i][a] = hn::MulAdd(weight, value[i], sum[i][a]);
    }
  }
#pragma GCC unroll 2
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) hn::StoreU(sum[i][a], d, to[i][a] + at);
}

/// to[i][a][at] += y[i][f] sums[a][f] over fibres whose y stays.
template <int n, class D, class T = hn::TFromD<D>>
HWY_INLINE void SpreadOverY(D d, const T* const (&y)[n], int fibres, const T* sums,
                            T* const* const (&to)[n], std::size_t at) {
  using V = hn::Vec<D>;
  V sum[n][6];
#pragma GCC unroll 2
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) sum[i][a] = hn::LoadU(d, to[i][a] + at);
  for (int f = 0; f < fibres; ++f) {
    V weight[n];
#pragma GCC unroll 2
    for (int i = 0; i < n; ++i) weight[i] = hn::Set(d, y[i][f]);
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) {
      const V value = hn::Load(d, sums + (a * PairBatch::kFibres + f) * hn::Lanes(d));
#pragma GCC unroll 2
      for (int i = 0; i < n; ++i) sum[i][a] = hn::MulAdd(weight[i], value, sum[i][a]);
    }
  }
#pragma GCC unroll 2
  for (int i = 0; i < n; ++i)
#pragma GCC unroll 6
    for (int a = 0; a < 6; ++a) hn::StoreU(sum[i][a], d, to[i][a] + at);
}

/// One vector of lanes: sums over each fibre first, of the end that moves, then over the fibres.
template <bool with_inertia, bool x_stays, class D, class T = hn::TFromD<D>>
HWY_INLINE void AccumulateLanes(D d, std::size_t lane, const LaneTable<T>& table,
                                const PairBatch& batch, PairScratch<T>& scratch,
                                const PairSums<T>& sums) {
  const std::size_t entry = sums.lanes;
  const std::size_t step = PairBatch::kFibres * hn::Lanes(d);
  // of the end that moves: six shapes, of y one and three hats for tractions, one for pressure
  constexpr int kOfAdjoint = x_stays ? 4 : 6, kOfPressure = x_stays ? 1 : 6;
  T* const inertia = scratch.fibre_sums;
  T* const adjoint = inertia + 54 * step;
  T* const pressure = adjoint + 9 * kOfAdjoint * step;
  for (int f = 0; f < batch.fibres; ++f) {
    const int begin = batch.begin[f], end = batch.begin[f + 1];
    const std::size_t at = f * hn::Lanes(d);
    EvaluateFibre<kFirstFunction<with_inertia>>(d, table, lane, begin, end, scratch);
    if constexpr (with_inertia)
      SumTensor<5, 6>(d, kInertiaTensor, 1, begin, end, scratch, inertia + at);
    SumTensor<3, kOfAdjoint>(d, kAdjointTensor, x_stays ? 0 : 1, begin, end, scratch, adjoint + at);
    SumTensor<1, kOfPressure>(d, kPressureTensor, x_stays ? 0 : 1, begin, end, scratch,
                              pressure + at);
  }
  const auto at_entry = [&](int e) { return e * entry + lane; };
  const auto spread = [&](int y_first, int y_second, const T* first, std::size_t shapes, int e,
                          T* const* to_first, T* const* to_second) {
    T* const* const to[2] = {to_first, to_second};
    if constexpr (x_stays) {
      const T* const from[2] = {first + e * shapes * step, first + (e * shapes + 1) * step};
      SpreadOverX(d, scratch.staying + 1, batch.fibres, from, to, at_entry(e));
    } else {
      const T* const y[2] = {scratch.staying[y_first], scratch.staying[y_second]};
      SpreadOverY(d, y, batch.fibres, first + e * shapes * step, to, at_entry(e));
    }
  };
  // moving shapes of y stand one after another, of x they are all needed for any of y
  const auto at_shape = [&](const T* from, int y) { return x_stays ? from + y * step : from; };
  for (int e = 0; e < 9; ++e) {
    if constexpr (with_inertia)
      for (int y = 0; y < 6; y += 2)
        spread(y + 1, y + 2, at_shape(inertia, y), 6, e, sums.inertia[y], sums.inertia[y + 1]);
    spread(0, 1, at_shape(adjoint, 0), kOfAdjoint, e, sums.uniform, sums.adjoint[0]);
    spread(2, 3, at_shape(adjoint, 2), kOfAdjoint, e, sums.adjoint[1], sums.adjoint[2]);
  }
  for (int e = 0; e < 3; ++e) {
    T* const* const to[1] = {sums.uniform};
    if constexpr (x_stays) {
      const T* const from[1] = {pressure + e * step};
      SpreadOverX(d, scratch.staying + 1, batch.fibres, from, to, at_entry(9 + e));
    } else {
      const T* const y[1] = {scratch.staying[0]};
      SpreadOverY(d, y, batch.fibres, pressure + 6 * e * step, to, at_entry(9 + e));
    }
  }
}

template <bool with_inertia, bool x_stays, class T>
void AccumulateBatch(const LaneTable<T>& table, const PairBatch& batch, PairScratch<T>& scratch,
                     const PairSums<T>& sums) {
  ForLanes<T>(std::min(scratch.used_lanes, sums.lanes), [&](auto d, std::size_t lane) {
    AccumulateLanes<with_inertia, x_stays>(d, lane, table, batch, scratch, sums);
  });
}

template <class T>
void AccumulatePair(const LaneTable<T>& table, const PairScales& scales, const Vec3& m,
                    const Vec3& n, const PairBatch& batch, PairScratch<T>& scratch,
                    const PairSums<T>& sums) {
  const auto normal = [&n](auto d, int axis, int) { return hn::Set(d, static_cast<T>(n[axis])); };
  PairCoefficients(table, scales, m, batch.r, normal, batch.padded_size(), scratch);
  LoadShapes(batch, scratch);
  const auto accumulate =
      sums.inertia[0][0]
          ? (batch.x_stays ? AccumulateBatch<true, true, T> : AccumulateBatch<true, false, T>)
          : (batch.x_stays ? AccumulateBatch<false, true, T> : AccumulateBatch<false, false, T>);
  accumulate(table, batch, scratch, sums);
}

void AccumulatePairDouble(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                          const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                          const PairSums<double>& sums) {
  AccumulatePair(table, scales, m, n, batch, scratch, sums);
}
void AccumulatePairFloat(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                         const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                         const PairSums<float>& sums) {
  AccumulatePair(table, scales, m, n, batch, scratch, sums);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(AccumulatePairDouble);
HWY_EXPORT(AccumulatePairFloat);

void accumulate_pair(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairDouble)(table, scales, m, n, batch, scratch, sums);
}

void accumulate_pair(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairFloat)(table, scales, m, n, batch, scratch, sums);
}

}  // namespace bem
#endif
