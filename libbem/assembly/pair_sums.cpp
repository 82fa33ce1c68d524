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
template <class D, class T = hn::TFromD<D>>
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
      V z = hn::Mul(at(kOfAlpha + e), f[kAlpha]);
      z = hn::MulAdd(at(kOfBeta + e), f[kBeta], z);
      z = hn::MulAdd(at(kOfGamma + e), f[kGamma], z);
      z = hn::MulAdd(at(kOfDelta + e), f[kDelta], z);
      z = hn::MulAdd(at(kOfEpsilon + e), f[kEpsilon], z);
      hn::Store(z, d, out + e * step);
      V j = hn::Mul(at(kOfP + e), f[kDynamicP]);
      j = hn::MulAdd(at(kOfQ + e), f[kDynamicQ], j);
      j = hn::MulAdd(at(kOfS + e), f[kDynamicS], j);
      hn::Store(j, d, out + (9 + e) * step);
    }
    for (int e = 0; e < 3; ++e)
      hn::Store(hn::Mul(at(kOfDilation + e), f[kDilation]), d, out + (18 + e) * step);
  }
}

template <class T>
void AccumulatePair(const LaneTable<T>& table, const PairScales& scales, const PairBatch& batch,
                    PairScratch<T>& scratch, T* HWY_RESTRICT sums) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  const std::size_t stride = table.padded_lanes;
  const std::size_t step = PairBatch::kCapacity * hn::Lanes(d);
  PairCoefficients(table, scales, batch, scratch);
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    EvaluateTensors(d, table, lane, batch.size, scratch);
    const auto rows = [&](auto count, const auto* weight, int tensor, int sum) {
      AccumulateRows<decltype(count)::value>(d, weight, batch.size, scratch.values + tensor * step,
                                             sums + sum * stride + lane, stride);
    };
    using Twelve = std::integral_constant<int, 12>;
    using Nine = std::integral_constant<int, 9>;
    using Six = std::integral_constant<int, 6>;
    for (int e = 0; e < 9; ++e) {
      for (int first = 0; first < 36; first += 12)
        rows(Twelve(), scratch.weight + first, e, inertia_sum(e, 0, 0) + first);
      for (int first = 0; first < 18; first += 9)
        rows(Nine(), scratch.weight + first, 9 + e, adjoint_sum(e, 0, 0) + first);
    }
    for (int e = 0; e < 3; ++e) rows(Six(), scratch.x_weight, 18 + e, kSumPressure + 6 * e);
  }
}

template <class T>
void AddPair(const T* HWY_RESTRICT sums, int padded_lanes, const PairTarget<T>& target) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t stride = padded_lanes;
  const auto add = [&](T* HWY_RESTRICT to, V value) {
    hn::Store(hn::Add(hn::Load(d, to), value), d, to);
  };
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d))
    for (int row = 0; row < target.rows; ++row) {
      const T* w = target.row_weights + 6 * row;
      const std::size_t first = target.row_slots[row] * target.block_columns;
      const auto at = [&](T* block, int slot, int e) {
        return block + ((first + slot) * 9 + e) * stride + lane;
      };
      // the shapes of x that the row has
      const auto combined = [&](int sum) {
        V total = hn::Mul(hn::Set(d, w[0]), hn::Load(d, sums + sum * stride + lane));
#pragma GCC unroll 5
        for (int a = 1; a < 6; ++a)
          total =
              hn::MulAdd(hn::Set(d, w[a]), hn::Load(d, sums + (sum + a) * stride + lane), total);
        return total;
      };
      for (int e = 0; e < 9; ++e) {
        V part[6];
#pragma GCC unroll 6
        for (int b = 0; b < 6; ++b) part[b] = combined(inertia_sum(e, b, 0));
        for (int column = 0; column < target.columns; ++column) {
          const T* v = target.column_weights + 6 * column;
          V total = hn::Mul(hn::Set(d, v[0]), part[0]);
#pragma GCC unroll 5
          for (int b = 1; b < 6; ++b) total = hn::MulAdd(hn::Set(d, v[b]), part[b], total);
          add(at(target.inertia, target.column_slots[column], e), total);
        }
        for (int b = 0; b < 3; ++b)
          add(at(target.adjoint, target.corner_slots[b], e), combined(adjoint_sum(e, b, 0)));
      }
    }
}

template <class T>
void AddPairStrain(const T* HWY_RESTRICT sums, int padded_lanes,
                   const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                   T* HWY_RESTRICT out) {
  const hn::CappedTag<T, LaneTable<T>::kLanePadding> d;
  using V = hn::Vec<decltype(d)>;
  const std::size_t stride = padded_lanes;
  for (std::size_t lane = 0; lane < stride; lane += hn::Lanes(d)) {
    const auto sum = [&](int row) { return hn::Load(d, sums + row * stride + lane); };
    for (int a = 0; a < 6; ++a)
      for (int i = 0; i < 3; ++i) {
        V j[3];
        for (int l = 0; l < 3; ++l) {
          const int e = 3 * i + l;
          j[l] = hn::Add(sum(adjoint_sum(e, 0, a)),
                         hn::Add(sum(adjoint_sum(e, 1, a)), sum(adjoint_sum(e, 2, a))));
        }
        const V p = sum(kSumPressure + 6 * i + a);
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

void AddPairDouble(const double* HWY_RESTRICT sums, int padded_lanes,
                   const PairTarget<double>& target) {
  AddPair(sums, padded_lanes, target);
}
void AddPairFloat(const float* HWY_RESTRICT sums, int padded_lanes,
                  const PairTarget<float>& target) {
  AddPair(sums, padded_lanes, target);
}
void AddPairStrainDouble(const double* HWY_RESTRICT sums, int padded_lanes,
                         const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                         double* HWY_RESTRICT out) {
  AddPairStrain(sums, padded_lanes, tractions, pressure, out);
}
void AddPairStrainFloat(const float* HWY_RESTRICT sums, int padded_lanes,
                        const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                        float* HWY_RESTRICT out) {
  AddPairStrain(sums, padded_lanes, tractions, pressure, out);
}

void AccumulatePairDouble(const LaneTable<double>& table, const PairScales& scales,
                          const PairBatch& batch, PairScratch<double>& scratch,
                          double* HWY_RESTRICT sums) {
  AccumulatePair(table, scales, batch, scratch, sums);
}
void AccumulatePairFloat(const LaneTable<float>& table, const PairScales& scales,
                         const PairBatch& batch, PairScratch<float>& scratch,
                         float* HWY_RESTRICT sums) {
  AccumulatePair(table, scales, batch, scratch, sums);
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
HWY_EXPORT(AddPairDouble);
HWY_EXPORT(AddPairFloat);
HWY_EXPORT(AddPairStrainDouble);
HWY_EXPORT(AddPairStrainFloat);

void PairBatch::pad() {
  for (int q = size; q < padded_size(); ++q) {
    for (int i = 0; i < 3; ++i) r[i][q] = r[i][0];
    for (int a = 0; a < 6; ++a) x_shape[a][q] = y_shape[a][q] = 0;
  }
}

void accumulate_pair(const LaneTable<double>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<double>& scratch, double* sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairDouble)(table, scales, batch, scratch, sums);
}

void accumulate_pair(const LaneTable<float>& table, const PairScales& scales,
                     const PairBatch& batch, PairScratch<float>& scratch, float* sums) {
  HWY_DYNAMIC_DISPATCH(AccumulatePairFloat)(table, scales, batch, scratch, sums);
}

void add_pair(const double* sums, int padded_lanes, const PairTarget<double>& target) {
  HWY_DYNAMIC_DISPATCH(AddPairDouble)(sums, padded_lanes, target);
}

void add_pair(const float* sums, int padded_lanes, const PairTarget<float>& target) {
  HWY_DYNAMIC_DISPATCH(AddPairFloat)(sums, padded_lanes, target);
}

void add_pair_strain(const double* sums, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     double* out) {
  HWY_DYNAMIC_DISPATCH(AddPairStrainDouble)(sums, padded_lanes, tractions, pressure, out);
}

void add_pair_strain(const float* sums, int padded_lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     float* out) {
  HWY_DYNAMIC_DISPATCH(AddPairStrainFloat)(sums, padded_lanes, tractions, pressure, out);
}

void accumulate_pair_reference(const LaneTable<double>& table, const PairScales& scales,
                               const PairBatch& batch, double* sums) {
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
        for (int e = 0; e < 9; ++e)
          for (int y = 0; y < 6; ++y) {
            const double weight = batch.x_shape[x][q] * batch.y_shape[y][q];
            sums[inertia_sum(e, y, x) * stride + lane] += weight * inertia(e / 3, e % 3);
            if (y < 3) sums[adjoint_sum(e, y, x) * stride + lane] += weight * adjoint(e / 3, e % 3);
          }
        for (int e = 0; e < 3; ++e)
          sums[(kSumPressure + 6 * e + x) * stride + lane] += batch.x_shape[x][q] * pressure[e];
      }
    }
  }
}

}  // namespace bem
#endif
