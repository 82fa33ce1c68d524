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

/// Tensor coefficients and products of shape functions of all points, lanes over points; also finds
/// the table intervals.
template <class T>
void PairCoefficients(const LaneTable<T>& table, const PairScales& scales, const PairBatch& batch,
                      PairScratch<T>& scratch) {
  const hn::CappedTag<T, PairBatch::kPadding> d;
  using V = hn::Vec<decltype(d)>;
  const auto set = [&d](double value) { return hn::Set(d, static_cast<T>(value)); };
  const Vec3 &mv = scales.m, &nv = scales.n;
  const V m[3] = {set(mv[0]), set(mv[1]), set(mv[2])}, n[3] = {set(nv[0]), set(nv[1]), set(nv[2])};
  const V mn = set(mv.dot(nv));
  const V one = set(1.0);
  const V inertia_scale = set(scales.density / (4 * kPi)), adjoint_scale = set(-1 / (4 * kPi));
  const V normal_part = set(1 - 2 * scales.kappa), other_part = set(2 * scales.kappa);
  alignas(64) T intervals[kPairCapacity];
  for (int q = 0; q < batch.padded_size(); q += static_cast<int>(hn::Lanes(d))) {
    const V x = LoadPoints(d, batch.r[0] + q), y = LoadPoints(d, batch.r[1] + q),
            z = LoadPoints(d, batch.r[2] + q);
    const V r = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const V inverse = hn::Div(one, r);
    const V h[3] = {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
    const auto dot = [&h](const V* v) {
      return hn::MulAdd(h[0], v[0], hn::MulAdd(h[1], v[1], hn::Mul(h[2], v[2])));
    };
    const V hm = dot(m), hn_ = dot(n);

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

    for (int a = 0; a < 6; ++a) {
      const V x_shape = LoadPoints(d, batch.x_shape[a] + q);
      hn::Store(x_shape, d, scratch.x_weight[a] + q);
      for (int b = 0; b < 6; ++b)
        hn::Store(hn::Mul(x_shape, LoadPoints(d, batch.y_shape[b] + q)), d,
                  scratch.weight[6 * b + a] + q);
    }
  }
  for (int q = 0; q < batch.padded_size(); ++q)
    scratch.interval[q] = table.interval(static_cast<int>(intervals[q]));
}

/// The kernels at all points for a vector of lanes: values[tensor entry][point].
template <bool with_inertia, class D, class T = hn::TFromD<D>>
HWY_INLINE void EvaluateTensors(D d, const LaneTable<T>& table, std::size_t lane, int size,
                                PairScratch<T>& scratch) {
  constexpr int kNodes = LaneTable<T>::kNodes;
  using V = hn::Vec<D>;
  const std::size_t stride = table.padded_lanes;
  const std::size_t step = PairBatch::kCapacity * hn::Lanes(d);
  for (int q = 0; q < size; ++q) {
    const T* HWY_RESTRICT c = scratch.interval[q] + lane;
    const V t = hn::Set(d, scratch.local[q]);
    V f[kHypersingularCount];
#pragma GCC unroll 9
    for (int k = 0; k < kHypersingularCount; ++k)
      f[k] = hn::Load(d, c + (k * kNodes + kNodes - 1) * stride);
#pragma GCC unroll 8
    for (int degree = kNodes - 2; degree >= 0; --degree)
#pragma GCC unroll 9
      for (int k = 0; k < kHypersingularCount; ++k)
        f[k] = hn::MulAdd(f[k], t, hn::Load(d, c + (k * kNodes + degree) * stride));
    const auto at = [&](int row) { return hn::Set(d, scratch.coefficient[row][q]); };
    T* HWY_RESTRICT out = scratch.values + q * hn::Lanes(d);
#pragma GCC unroll 9
    for (int e = 0; e < 9; ++e) {
      if constexpr (with_inertia) {
        V z = hn::Mul(at(kOfAlpha + e), f[kAlpha]);
        z = hn::MulAdd(at(kOfBeta + e), f[kBeta], z);
        z = hn::MulAdd(at(kOfGamma + e), f[kGamma], z);
        z = hn::MulAdd(at(kOfDelta + e), f[kDelta], z);
        z = hn::MulAdd(at(kOfEpsilon + e), f[kEpsilon], z);
        hn::Store(z, d, out + e * step);
      }
      V j = hn::Mul(at(kOfP + e), f[kDynamicP]);
      j = hn::MulAdd(at(kOfQ + e), f[kDynamicQ], j);
      j = hn::MulAdd(at(kOfS + e), f[kDynamicS], j);
      hn::Store(j, d, out + (9 + e) * step);
    }
    for (int e = 0; e < 3; ++e)
      hn::Store(hn::Mul(at(kOfDilation + e), f[kDilation]), d, out + (18 + e) * step);
  }
}

/// a[i] += weight_a[i][q] values[q] and b[i] += weight_b[i][q] values[q] for the six shapes of x.
template <class D, int row_size, class T = hn::TFromD<D>>
HWY_INLINE void AccumulateTwice(D d, const T (*weight_a)[row_size], const T (*weight_b)[row_size],
                                int size, const T* HWY_RESTRICT values, T* a, T* b,
                                std::size_t stride) {
  using V = hn::Vec<D>;
  V sum_a[6], sum_b[6];
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    sum_a[i] = hn::Load(d, a + i * stride);
    sum_b[i] = hn::Load(d, b + i * stride);
  }
  for (int q = 0; q < size; ++q) {
    const V value = hn::Load(d, values + q * hn::Lanes(d));
#pragma GCC unroll 6
    for (int i = 0; i < 6; ++i) {
      sum_a[i] = hn::MulAdd(hn::Set(d, weight_a[i][q]), value, sum_a[i]);
      sum_b[i] = hn::MulAdd(hn::Set(d, weight_b[i][q]), value, sum_b[i]);
    }
  }
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
    hn::Store(sum_a[i], d, a + i * stride);
    hn::Store(sum_b[i], d, b + i * stride);
  }
}

template <bool with_inertia, class T>
void AccumulateLanes(const LaneTable<T>& table, const PairBatch& batch, PairScratch<T>& scratch,
                     const PairSums<T>& sums) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  const std::size_t stride = table.padded_lanes, entry = 6 * stride;
  const std::size_t step = PairBatch::kCapacity * hn::Lanes(d);
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    EvaluateTensors<with_inertia>(d, table, lane, batch.size, scratch);
    const auto twice = [&](const auto* weight_a, const auto* weight_b, int tensor, T* a, T* b) {
      AccumulateTwice(d, weight_a, weight_b, batch.size, scratch.values + tensor * step, a + lane,
                      b + lane, stride);
    };
    for (int e = 0; e < 9; ++e) {
      if constexpr (with_inertia)
        for (int y = 0; y < 6; y += 2)
          twice(scratch.weight + 6 * y, scratch.weight + 6 * (y + 1), e,
                sums.inertia[y] + e * entry, sums.inertia[y + 1] + e * entry);
      twice(scratch.weight, scratch.weight + 6, 9 + e, sums.adjoint[0] + e * entry,
            sums.adjoint[1] + e * entry);
      twice(scratch.weight + 12, scratch.x_weight, 9 + e, sums.adjoint[2] + e * entry,
            sums.uniform + e * entry);
    }
    for (int e = 0; e < 3; ++e)
      AccumulateRows<6>(d, scratch.x_weight, batch.size, scratch.values + (18 + e) * step,
                        sums.uniform + (9 + e) * entry + lane, stride);
  }
}

template <class T>
void AccumulatePair(const LaneTable<T>& table, const PairScales& scales, const PairBatch& batch,
                    PairScratch<T>& scratch, const PairSums<T>& sums) {
  PairCoefficients(table, scales, batch, scratch);
  if (sums.inertia[0])
    AccumulateLanes<true>(table, batch, scratch, sums);
  else
    AccumulateLanes<false>(table, batch, scratch, sums);
}

template <class T>
void AddScaled(T factor, const T* HWY_RESTRICT from, T* HWY_RESTRICT to, std::size_t size) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  const auto f = hn::Set(d, factor);
  for (std::size_t i = 0; i < size; i += hn::Lanes(d))
    hn::Store(hn::MulAdd(f, hn::Load(d, from + i), hn::Load(d, to + i)), d, to + i);
}

template <class T>
void CombineShapes(const T* HWY_RESTRICT weights, const T* HWY_RESTRICT from, int entries,
                   int padded_lanes, T* HWY_RESTRICT to) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  const std::size_t stride = padded_lanes;
  int used[6], count = 0;
  for (int a = 0; a < 6; ++a)
    if (weights[a] != 0) used[count++] = a;
  for (int e = 0; e < entries; ++e)
    for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
      const T* HWY_RESTRICT source = from + 6 * e * stride + lane;
      T* HWY_RESTRICT target = to + e * stride + lane;
      auto total = hn::Load(d, target);
      for (int k = 0; k < count; ++k)
        total =
            hn::MulAdd(hn::Set(d, weights[used[k]]), hn::Load(d, source + used[k] * stride), total);
      hn::Store(total, d, target);
    }
}

template <class T>
void AddStrain(const T* HWY_RESTRICT uniform, int padded_lanes,
               const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
               T* HWY_RESTRICT out) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t stride = padded_lanes;
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    const auto sum = [&](int entry, int a) {
      return hn::Load(d, uniform + (6 * entry + a) * stride + lane);
    };
    for (int a = 0; a < 6; ++a)
      for (int i = 0; i < 3; ++i) {
        const V j[3] = {sum(3 * i, a), sum(3 * i + 1, a), sum(3 * i + 2, a)}, p = sum(9 + i, a);
        for (int c = 0; c < 6; ++c) {
          T* HWY_RESTRICT to = out + ((a * 3 + i) * 6 + c) * stride + lane;
          V total = hn::MulAdd(hn::Set(d, static_cast<T>(pressure[c])), p, hn::Load(d, to));
          for (int l = 0; l < 3; ++l)
            total = hn::MulAdd(hn::Set(d, static_cast<T>(tractions(l, c))), j[l], total);
          hn::Store(total, d, to);
        }
      }
  }
}

void AccumulatePairDouble(const LaneTable<double>& table, const PairScales& scales,
                          const PairBatch& batch, PairScratch<double>& scratch,
                          const PairSums<double>& sums) {
  AccumulatePair(table, scales, batch, scratch, sums);
}
void AddScaledDouble(double factor, const double* from, double* to, std::size_t size) {
  AddScaled(factor, from, to, size);
}
void CombineShapesDouble(const double* weights, const double* from, int entries, int padded_lanes,
                         double* to) {
  CombineShapes(weights, from, entries, padded_lanes, to);
}
void AddStrainDouble(const double* uniform, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     double* out) {
  AddStrain(uniform, padded_lanes, tractions, pressure, out);
}
void AccumulatePairFloat(const LaneTable<float>& table, const PairScales& scales,
                         const PairBatch& batch, PairScratch<float>& scratch,
                         const PairSums<float>& sums) {
  AccumulatePair(table, scales, batch, scratch, sums);
}
void AddScaledFloat(float factor, const float* from, float* to, std::size_t size) {
  AddScaled(factor, from, to, size);
}
void CombineShapesFloat(const float* weights, const float* from, int entries, int padded_lanes,
                        float* to) {
  CombineShapes(weights, from, entries, padded_lanes, to);
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
HWY_EXPORT(AddScaledDouble);
HWY_EXPORT(AddScaledFloat);
HWY_EXPORT(CombineShapesDouble);
HWY_EXPORT(CombineShapesFloat);
HWY_EXPORT(AddStrainDouble);
HWY_EXPORT(AddStrainFloat);

void PairBatch::pad() {
  for (int q = size; q < padded_size(); ++q) {
    for (int i = 0; i < 3; ++i) r[i][q] = r[i][0];
    for (int a = 0; a < 6; ++a) x_shape[a][q] = y_shape[a][q] = 0;
  }
}

void accumulate_pair(const LaneTable<double>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<double>& scratch,
                     const PairSums<double>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairDouble)(table, scales, batch, scratch, sums);
}

void add_scaled(double factor, const double* from, double* to, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(AddScaledDouble)(factor, from, to, size);
}

void combine_shapes(const double* weights, const double* from, int entries, int padded_lanes,
                    double* to) {
  HWY_DYNAMIC_DISPATCH(CombineShapesDouble)(weights, from, entries, padded_lanes, to);
}

void add_strain(const double* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                double* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainDouble)(uniform, padded_lanes, tractions, pressure, out);
}

void accumulate_pair(const LaneTable<float>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<float>& scratch,
                     const PairSums<float>& sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairFloat)(table, scales, batch, scratch, sums);
}

void add_scaled(float factor, const float* from, float* to, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(AddScaledFloat)(factor, from, to, size);
}

void combine_shapes(const float* weights, const float* from, int entries, int padded_lanes,
                    float* to) {
  HWY_DYNAMIC_DISPATCH(CombineShapesFloat)(weights, from, entries, padded_lanes, to);
}

void add_strain(const float* uniform, int padded_lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainFloat)(uniform, padded_lanes, tractions, pressure, out);
}

void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const PairBatch& batch, const PairSums<double>& sums) {
  const std::size_t stride = table.padded_lanes;
  std::vector<double> values(kHypersingularCount * stride);
  for (int q = 0; q < batch.size; ++q) {
    const Vec3 r(batch.r[0][q], batch.r[1][q], batch.r[2][q]);
    const SurfacePair g = surface_pair(Vec3::Zero(), scales.m, r, scales.n);
    table.evaluate(g.r * scales.lam_per_distance, values.data());
    for (int lane = 0; lane < table.lanes; ++lane) {
      HypersingularValues<double> f;
      for (int k = 0; k < kHypersingularCount; ++k) f[k] = values[k * stride + lane];
      const Mat3 inertia = inertia_kernel(g, f, scales.density),
                 adjoint = dynamic_adjoint_kernel(g, f);
      const Vec3 pressure = pressure_kernel(g, f, scales.kappa);
      for (int x = 0; x < 6; ++x) {
        const double weight = batch.x_shape[x][q];
        const auto add = [&](double* to, int entry, double value) {
          to[(6 * entry + x) * stride + lane] += value;
        };
        for (int e = 0; e < 9; ++e) {
          for (int y = 0; y < 6; ++y)
            add(sums.inertia[y], e, weight * batch.y_shape[y][q] * inertia(e / 3, e % 3));
          for (int y = 0; y < 3; ++y)
            add(sums.adjoint[y], e, weight * batch.y_shape[y][q] * adjoint(e / 3, e % 3));
          add(sums.uniform, e, weight * adjoint(e / 3, e % 3));
        }
        for (int e = 0; e < 3; ++e) add(sums.uniform, 9 + e, weight * pressure[e]);
      }
    }
  }
}

}  // namespace bem
#endif
