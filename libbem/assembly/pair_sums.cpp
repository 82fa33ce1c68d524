// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/pair_sums.cpp"
#include "assembly/pair_sums.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format off: after foreach_target.h
#include "assembly/lane_sums-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kPairCapacity = PairBatch::kCapacity;

// Rows of PairScratch::coefficient: 3x3 tensors of the functions.
enum : int {
  kOfAlpha = 0,
  kOfBeta = kOfAlpha + 9,
  kOfGamma = kOfBeta + 9,
  kOfDelta = kOfGamma + 9,
  kOfEpsilon = kOfDelta + 9,
  kOfP = kOfEpsilon + 9,
  kOfQ = kOfP + 9,
  kOfS = kOfQ + 9,
  kOfDilation = kOfS + 9,
};
static_assert(kOfDilation + 3 == PairScratch<double>::kCoefficients);

/// Tensor coefficients of points y seen from one x, lanes over points; also finds the table
/// intervals. normal(axis, q): of y.
template <class T, class Normal>
void PairCoefficients(const LaneTable<T>& table, const PairScales& scales, const Vec3& normal_at_x,
                      const double (*offset)[kPairCapacity], const Normal& normal, int padded_size,
                      PairScratch<T>& scratch) {
  const hn::CappedTag<T, PairBatch::kPadding> d;
  using V = hn::Vec<decltype(d)>;
  const auto set = [&d](double value) { return hn::Set(d, static_cast<T>(value)); };
  const V m[3] = {set(normal_at_x[0]), set(normal_at_x[1]), set(normal_at_x[2])};
  const V one = set(1.0);
  const V inertia_scale = set(scales.density / (4 * kPi)), adjoint_scale = set(-1 / (4 * kPi));
  const V normal_part = set(1 - 2 * scales.kappa), other_part = set(2 * scales.kappa);
  alignas(64) T intervals[kPairCapacity];
  for (int q = 0; q < padded_size; q += static_cast<int>(hn::Lanes(d))) {
    const V x = LoadPoints(d, offset[0] + q), y = LoadPoints(d, offset[1] + q),
            z = LoadPoints(d, offset[2] + q);
    const V n[3] = {normal(d, 0, q), normal(d, 1, q), normal(d, 2, q)};
    const V r = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const V inverse = hn::Div(one, r);
    const V h[3] = {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
    const auto dot = [&h](const V* v) {
      return hn::MulAdd(h[0], v[0], hn::MulAdd(h[1], v[1], hn::Mul(h[2], v[2])));
    };
    const V hm = dot(m), hn_ = dot(n);
    const V mn = hn::MulAdd(m[0], n[0], hn::MulAdd(m[1], n[1], hn::Mul(m[2], n[2])));

    StorePlaces(d, table, r, scales.lam_per_distance, intervals + q, scratch.local + q);

    const auto store = [&](int row, V value) { hn::Store(value, d, scratch.coefficient[row] + q); };
    const V s = hn::Mul(inertia_scale, inverse);
    const V shm = hn::Mul(s, hm), shn = hn::Mul(s, hn_), smn = hn::Mul(s, mn);
    const V shmn = hn::Mul(shm, hn_), chm = hn::Mul(adjoint_scale, hm);
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < 3; ++l) {
        const int e = 3 * i + l;
        const V hh = hn::Mul(h[i], h[l]), hm_il = hn::Mul(h[i], m[l]), nh = hn::Mul(n[i], h[l]);
        V alpha = hn::Mul(s, hn::Mul(n[i], m[l]));
        V beta = hn::MulAdd(shm, nh, hn::MulAdd(shn, hm_il, hn::Mul(smn, hh)));
        V p = hn::Mul(adjoint_scale, hm_il);
        if (i == l) {
          alpha = hn::Add(alpha, smn);
          beta = hn::Add(beta, shmn);
          p = hn::Add(p, chm);
        }
        const V mh = hn::Mul(m[i], h[l]);
        store(kOfAlpha + e, alpha);
        store(kOfBeta + e, beta);
        store(kOfGamma + e, hn::Mul(s, hn::Mul(m[i], n[l])));
        store(kOfDelta + e, hn::MulAdd(shn, mh, hn::Mul(shm, hn::Mul(h[i], n[l]))));
        store(kOfEpsilon + e, hn::Mul(shmn, hh));
        store(kOfP + e, p);
        store(kOfQ + e, hn::Mul(adjoint_scale, mh));
        store(kOfS + e, hn::Mul(chm, hh));
      }
    const V along_m = hn::Mul(hn::Mul(adjoint_scale, normal_part), hn_);
    const V along_n = hn::Mul(chm, other_part);
    for (int i = 0; i < 3; ++i)
      store(kOfDilation + i, hn::MulAdd(along_m, m[i], hn::Mul(along_n, n[i])));
  }
  for (int q = 0; q < padded_size; ++q)
    scratch.interval[q] = table.interval(static_cast<int>(intervals[q]));
}

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

/// The first radial function that is wanted, with Z or without it: those of J come last.
template <bool with_inertia>
constexpr int kFirstFunction = with_inertia ? kAlpha : kDynamicP;

/// The radial functions from `first` on at one point for a vector of lanes.
template <int first, class D, class T = hn::TFromD<D>>
HWY_INLINE void EvaluateRadial(D d, std::size_t stride, const T* HWY_RESTRICT c, T local,
                               hn::Vec<D> (&f)[kHypersingularCount]) {
  constexpr int kNodes = LaneTable<T>::kNodes;
  const hn::Vec<D> t = hn::Set(d, local);
#pragma GCC unroll 9
  for (int k = first; k < kHypersingularCount; ++k)
    f[k] = hn::LoadU(d, c + (k * kNodes + kNodes - 1) * stride);
#pragma GCC unroll 8
  for (int degree = kNodes - 2; degree >= 0; --degree)
#pragma GCC unroll 9
    for (int k = first; k < kHypersingularCount; ++k)
      f[k] = hn::MulAdd(f[k], t, hn::LoadU(d, c + (k * kNodes + degree) * stride));
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
  const std::size_t entry = table.padded_lanes;
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
  ForLanes<T>(table.padded_lanes, [&](auto d, std::size_t lane) {
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

/// One vector of lanes of MidpointSums.
template <bool with_inertia, class D, class T = hn::TFromD<D>>
HWY_INLINE void EvaluateMidpointLanes(D d, std::size_t lane, const LaneTable<T>& table, int size,
                                      PairScratch<T>& scratch, const MidpointSums<T>& sums) {
  using V = hn::Vec<D>;
  const std::size_t stride = table.padded_lanes;
  V pressure[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int q = 0; q < size; ++q) {
    V f[kHypersingularCount];
    EvaluateRadial<kFirstFunction<with_inertia>>(d, stride, scratch.interval[q] + lane,
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
    for (int i = 0; i < 3; ++i)
      pressure[i] = hn::MulAdd(at(kOfDilation + i), f[kDilation], pressure[i]);
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
  ForLanes<T>(table.padded_lanes, [&](auto d, std::size_t lane) {
    if (sums.inertia)
      EvaluateMidpointLanes<true>(d, lane, table, batch.size, scratch, sums);
    else
      EvaluateMidpointLanes<false>(d, lane, table, batch.size, scratch, sums);
  });
}

/// `count` vectors of a row of CombineRows().
template <int count, class D, class T = hn::TFromD<D>>
HWY_INLINE void CombineRow(D d, const SparseRows& rows, int row, const T* from, std::size_t size,
                           T* to) {
  using V = hn::Vec<D>;
  V sum[count];
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) sum[i] = hn::Zero(d);
  for (int k = rows.begin[row]; k < rows.begin[row + 1]; ++k) {
    const V value = hn::Set(d, static_cast<T>(rows.values[k]));
    const T* HWY_RESTRICT source = from + rows.items[k] * size;
#pragma GCC unroll 8
    for (int i = 0; i < count; ++i)
      sum[i] = hn::MulAdd(value, hn::LoadU(d, source + i * hn::Lanes(d)), sum[i]);
  }
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) hn::StoreU(sum[i], d, to + i * hn::Lanes(d));
}

template <class T>
void CombineRows(const SparseRows& rows, const T* from, std::size_t size, T* to) {
  const WholeVector<T> d;
  constexpr std::size_t kTogether = 8;
  const std::size_t most = kTogether * hn::Lanes(d);
  for (int row = 0; row < rows.rows(); ++row) {
    T* const out = to + row * size;
    std::size_t at = 0;
    for (; at + most <= size; at += most)
      CombineRow<kTogether>(d, rows, row, from + at, size, out + at);
    ForLanes<T>(size - at, [&](auto tag, std::size_t rest) {
      CombineRow<1>(tag, rows, row, from + at + rest, size, out + at + rest);
    });
  }
}

template <class T>
void AddStrain(const T* HWY_RESTRICT uniform, int padded_lanes,
               const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
               T* HWY_RESTRICT out) {
  const std::size_t stride = padded_lanes;
  ForLanes<T>(stride, [&](auto d, std::size_t lane) {
    using V = hn::Vec<decltype(d)>;
    const auto sum = [&](int entry) { return hn::LoadU(d, uniform + entry * stride + lane); };
    for (int i = 0; i < 3; ++i) {
      const V j[3] = {sum(3 * i), sum(3 * i + 1), sum(3 * i + 2)}, p = sum(9 + i);
      for (int c = 0; c < 6; ++c) {
        T* HWY_RESTRICT to = out + (i * 6 + c) * stride + lane;
        V total = hn::MulAdd(hn::Set(d, static_cast<T>(pressure[c])), p, hn::LoadU(d, to));
        for (int l = 0; l < 3; ++l)
          total = hn::MulAdd(hn::Set(d, static_cast<T>(tractions(l, c))), j[l], total);
        hn::StoreU(total, d, to);
      }
    }
  });
}

void AccumulatePairDouble(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                          const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                          const PairSums<double>& sums) {
  AccumulatePair(table, scales, m, n, batch, scratch, sums);
}
void EvaluateMidpointsDouble(const LaneTable<double>& table, const PairScales& scales,
                             const Vec3& m, const MidpointBatch& batch,
                             PairScratch<double>& scratch, const MidpointSums<double>& sums) {
  EvaluateMidpoints(table, scales, m, batch, scratch, sums);
}
void CombineRowsDouble(const SparseRows& rows, const double* from, std::size_t size, double* to) {
  CombineRows(rows, from, size, to);
}
void AddStrainDouble(const double* uniform, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     double* out) {
  AddStrain(uniform, padded_lanes, tractions, pressure, out);
}
void AccumulatePairFloat(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                         const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                         const PairSums<float>& sums) {
  AccumulatePair(table, scales, m, n, batch, scratch, sums);
}
void EvaluateMidpointsFloat(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                            const MidpointBatch& batch, PairScratch<float>& scratch,
                            const MidpointSums<float>& sums) {
  EvaluateMidpoints(table, scales, m, batch, scratch, sums);
}
void CombineRowsFloat(const SparseRows& rows, const float* from, std::size_t size, float* to) {
  CombineRows(rows, from, size, to);
}
void AddStrainFloat(const float* uniform, int padded_lanes,
                    const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                    float* out) {
  AddStrain(uniform, padded_lanes, tractions, pressure, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "kernels/hypersingular_tensors.hpp"

#include <vector>

namespace bem {

HWY_EXPORT(AccumulatePairDouble);
HWY_EXPORT(AccumulatePairFloat);
HWY_EXPORT(EvaluateMidpointsDouble);
HWY_EXPORT(EvaluateMidpointsFloat);
HWY_EXPORT(CombineRowsDouble);
HWY_EXPORT(CombineRowsFloat);
HWY_EXPORT(AddStrainDouble);
HWY_EXPORT(AddStrainFloat);

void PairBatch::pad() {
  for (int q = size; q < padded_size(); ++q) {
    for (auto& component : r) component[q] = component[0];
    for (auto& shape : moving) shape[q] = 0;
  }
}

void accumulate_pair(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairDouble)(table, scales, m, n, batch, scratch, sums);
}

void evaluate_midpoints(const LaneTable<double>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<double>& scratch,
                        const MidpointSums<double>& sums) {
  HWY_DYNAMIC_DISPATCH(EvaluateMidpointsDouble)(table, scales, m, batch, scratch, sums);
}

void combine_rows(const SparseRows& rows, const double* from, std::size_t size, double* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsDouble)(rows, from, size, to);
}

void add_strain(const double* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                double* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainDouble)(uniform, padded_lanes, tractions, pressure, out);
}

void accumulate_pair(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                     const Vec3& n, const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairFloat)(table, scales, m, n, batch, scratch, sums);
}

void evaluate_midpoints(const LaneTable<float>& table, const PairScales& scales, const Vec3& m,
                        const MidpointBatch& batch, PairScratch<float>& scratch,
                        const MidpointSums<float>& sums) {
  HWY_DYNAMIC_DISPATCH(EvaluateMidpointsFloat)(table, scales, m, batch, scratch, sums);
}

void combine_rows(const SparseRows& rows, const float* from, std::size_t size, float* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsFloat)(rows, from, size, to);
}

void add_strain(const float* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainFloat)(uniform, padded_lanes, tractions, pressure, out);
}

void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const Vec3& m, const Vec3& n, const PairBatch& batch,
                               const PairSums<double>& sums) {
  const std::size_t stride = table.padded_lanes;
  std::vector<double> values(kHypersingularCount * stride);
  int fibre = 0;
  for (int q = 0; q < batch.size; ++q) {
    if (q == batch.begin[fibre + 1]) ++fibre;
    const auto shape = [&](bool of_x, int row) {
      return of_x == batch.x_stays ? batch.staying[row][fibre] : batch.moving[row][q];
    };
    const Vec3 r(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
    const SurfacePair g = surface_pair(Vec3::Zero(), m, r, n);
    table.evaluate(g.r * scales.lam_per_distance, values.data());
    for (int lane = 0; lane < table.lanes; ++lane) {
      HypersingularValues<double> f;
      for (int k = 0; k < kHypersingularCount; ++k) f[k] = values[k * stride + lane];
      const Mat3 inertia = inertia_kernel(g, f, scales.density),
                 adjoint = dynamic_adjoint_kernel(g, f);
      const Vec3 pressure = pressure_kernel(g, f, scales.kappa);
      for (int x = 0; x < 6; ++x) {
        const double weight = shape(true, x + 1);
        for (int e = 0; e < 9; ++e) {
          const std::size_t at = e * stride + lane;
          for (int y = 0; y < 6; ++y)
            sums.inertia[y][x][at] += weight * shape(false, y + 1) * inertia(e / 3, e % 3);
          for (int y = 0; y < 3; ++y)
            sums.adjoint[y][x][at] += weight * shape(false, y + 1) * adjoint(e / 3, e % 3);
          sums.uniform[x][at] += weight * shape(false, 0) * adjoint(e / 3, e % 3);
        }
        for (int e = 0; e < 3; ++e)
          sums.uniform[x][(9 + e) * stride + lane] += weight * shape(false, 0) * pressure[e];
      }
    }
  }
}

}  // namespace bem
#endif
