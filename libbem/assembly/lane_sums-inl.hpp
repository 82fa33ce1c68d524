// What sums over quadrature points in vector lanes have in common. Included after
// hwy/foreach_target.h, once per instruction set.
#if defined(BEM_LANE_SUMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef BEM_LANE_SUMS_INL
#undef BEM_LANE_SUMS_INL
#else
#define BEM_LANE_SUMS_INL
#endif

#include "kernels/radial_table.hpp"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using WholeVector = hn::CappedTag<T, 64 / sizeof(T)>;

/// f(tag, lane) for all lanes, a multiple of 32 bytes of them, vector by vector, of which the last
/// one may be half as wide.
template <class T, class F>
HWY_INLINE void ForLanes(std::size_t padded_lanes, const F& f) {
  const WholeVector<T> d;
  std::size_t lane = 0;
  for (; lane + hn::Lanes(d) <= padded_lanes; lane += hn::Lanes(d)) f(d, lane);
  const hn::CappedTag<T, 32 / sizeof(T)> rest;
  for (; lane < padded_lanes; lane += hn::Lanes(rest)) f(rest, lane);
}

template <class D>
HWY_INLINE hn::Vec<D> LoadPoints(D d, const double* HWY_RESTRICT from) {
  if constexpr (std::is_same_v<hn::TFromD<D>, double>) {
    return hn::LoadU(d, from);
  } else {
    alignas(64) hn::TFromD<D> narrow[64 / sizeof(float)];
    for (std::size_t i = 0; i < hn::Lanes(d); ++i) narrow[i] = static_cast<float>(from[i]);
    return hn::Load(d, narrow);
  }
}

/// The intervals of a table that distances r lie in, and the places in them, in [-1, 1].
template <class D, class T = hn::TFromD<D>>
HWY_INLINE void StorePlaces(D d, const LaneTable<T>& table, hn::Vec<D> r, double lam_per_distance,
                            T* HWY_RESTRICT intervals, T* HWY_RESTRICT local) {
  using V = hn::Vec<D>;
  const auto set = [&d](double value) { return hn::Set(d, static_cast<T>(value)); };
  const V scale = set(table.scale), first = set(-table.scale * table.graded(0));
  const V root = hn::Sqrt(hn::MulAdd(r, set(lam_per_distance), set(table.kGrading)));
  const V position = hn::MulAdd(hn::Mul(root, hn::Sqrt(root)), scale, first);
  const V last = set(table.intervals - 1.0);
  const V interval = hn::Max(hn::Min(hn::Floor(position), last), hn::Zero(d));  // rounding at 0
  const V offset = hn::Sub(position, interval);
  hn::Store(hn::Sub(hn::Add(offset, offset), set(1.0)), d, local);
  hn::Store(interval, d, intervals);
}

/// sums[i] += weight[i][q] * values[q] over the points, n rows held in registers.
template <int n, int row_size, class D, class T = hn::TFromD<D>>
HWY_INLINE void AccumulateRows(D d, const T (*weight)[row_size], int size,
                               const T* HWY_RESTRICT values, T* HWY_RESTRICT sums,
                               std::size_t stride) {
  using V = hn::Vec<D>;
  V sum[n];
#pragma GCC unroll 16
  for (int i = 0; i < n; ++i) sum[i] = hn::LoadU(d, sums + i * stride);
  for (int q = 0; q < size; ++q) {
    const V value = hn::Load(d, values + q * hn::Lanes(d));
#pragma GCC unroll 16
    for (int i = 0; i < n; ++i) sum[i] = hn::MulAdd(hn::Set(d, weight[i][q]), value, sum[i]);
  }
#pragma GCC unroll 16
  for (int i = 0; i < n; ++i) hn::StoreU(sum[i], d, sums + i * stride);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#endif
