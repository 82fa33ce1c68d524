// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/panel_sums.cpp"
#include "assembly/panel_sums.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format off: after foreach_target.h
#include "assembly/lane_sums-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kCapacity = PointBatch::kCapacity;

// Rows of PanelScratch::coefficient.
enum : int {
  kCoefA = 0,
  kCoefB = kCoefA + 3,
  kCoefPQ = kCoefB + 18,
  kCoefS = kCoefPQ + 9,
  kCoefF = kCoefS + 18,
  kCoefFr = kCoefF + 3,
  kCoefM1 = kCoefFr + 6,
  kCoefM0 = kCoefM1 + 1,
};
static_assert(kCoefM0 + 1 == PanelScratch<double>::kCoefficients);

/// Tensor coefficients of all points, lanes over points; also finds the table intervals.
template <class T>
void Coefficients(const LaneTable<T>& table, const KernelScales& scales, const PointBatch& batch,
                  const Vec3& normal, PanelScratch<T>& scratch) {
  const hn::CappedTag<T, PointBatch::kPadding> d;
  using V = hn::Vec<decltype(d)>;
  const auto set = [&d](double value) { return hn::Set(d, static_cast<T>(value)); };
  const V nx = set(normal[0]), ny = set(normal[1]), nz = set(normal[2]);
  const V one = set(1.0);
  alignas(64) T intervals[kCapacity];
  for (int q = 0; q < batch.padded_size(); q += static_cast<int>(hn::Lanes(d))) {
    const V x = LoadPoints(d, batch.r[0] + q), y = LoadPoints(d, batch.r[1] + q),
            z = LoadPoints(d, batch.r[2] + q);
    const V r = hn::Sqrt(hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
    const V inverse = hn::Div(one, r);
    const V h[3] = {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
    const V hh[6] = {hn::Mul(h[0], h[0]), hn::Mul(h[0], h[1]), hn::Mul(h[0], h[2]),
                     hn::Mul(h[1], h[1]), hn::Mul(h[1], h[2]), hn::Mul(h[2], h[2])};
    const V hn_ = hn::MulAdd(h[0], nx, hn::MulAdd(h[1], ny, hn::Mul(h[2], nz)));

    StorePlaces(d, table, r, scales.lam_per_distance, intervals + q, scratch.local + q);

    const auto store = [&](int row, V value) { hn::Store(value, d, scratch.coefficient[row] + q); };
    V weight = hn::Zero(d);
    const V u_scale = hn::Mul(set(scales.displacement), inverse);
    const V p_scale = hn::Mul(set(scales.traction), hn::Mul(inverse, inverse));
    for (int a = 0; a < 3; ++a) {
      const V w = LoadPoints(d, batch.shape_weight[a] + q);
      weight = hn::Add(weight, w);
      const V u = hn::Mul(w, u_scale);
      const V p = hn::Mul(w, p_scale);
      const V s = hn::Mul(p, hn_);
      store(kCoefA + a, u);
      for (int e = 0; e < 6; ++e) {
        store(kCoefB + 6 * a + e, hn::Neg(hn::Mul(u, hh[e])));
        store(kCoefS + 6 * a + e, hn::Mul(s, hh[e]));
      }
      for (int e = 0; e < 3; ++e) store(kCoefPQ + 3 * a + e, hn::Mul(p, h[e]));
    }
    const V body = hn::Mul(weight, set(scales.body_force));
    const V body_r = hn::Mul(body, r);
    for (int e = 0; e < 3; ++e) store(kCoefF + e, hn::Mul(body, h[e]));
    for (int e = 0; e < 6; ++e) store(kCoefFr + e, hn::Mul(body_r, hh[e]));
    store(kCoefM1, hn::Neg(hn::Mul(body, hn_)));
    store(kCoefM0, body_r);
  }
  for (int q = 0; q < batch.padded_size(); ++q)
    scratch.interval[q] = table.interval(static_cast<int>(intervals[q]));
}

template <class D, class T = hn::TFromD<D>>
HWY_INLINE void Accumulate(D d, const PanelScratch<T>& s, int function, int size,
                           const T* HWY_RESTRICT values, T* HWY_RESTRICT sums, std::size_t stride) {
  const auto rows = [&](auto count, int coefficient, int sum) {
    AccumulateRows<decltype(count)::value>(d, s.coefficient + coefficient, size, values,
                                           sums + sum * stride, stride);
  };
  using One = std::integral_constant<int, 1>;
  using Three = std::integral_constant<int, 3>;
  using Nine = std::integral_constant<int, 9>;
  switch (function) {
    case kRadialA:
      return rows(Three(), kCoefA, kSumA);
    case kRadialB:
      rows(Nine(), kCoefB, kSumB);
      return rows(Nine(), kCoefB + 9, kSumB + 9);
    case kRadialP:
      return rows(Nine(), kCoefPQ, kSumP);
    case kRadialQ:
      return rows(Nine(), kCoefPQ, kSumQ);
    case kRadialS:
      rows(Nine(), kCoefS, kSumS);
      return rows(Nine(), kCoefS + 9, kSumS + 9);
    case kRadialF:
      return rows(Nine(), kCoefF, kSumF);
    case kRadialM1:
      return rows(One(), kCoefM1, kSumM1);
    case kRadialM0:
      return rows(One(), kCoefM0, kSumM0);
    default:
      return rows(One(), kCoefM0, kSumC0);
  }
}

template <class T>
void Accumulate(const LaneTable<T>& table, const KernelScales& scales, const PointBatch& batch,
                const Vec3& normal, PanelScratch<T>& scratch, T* HWY_RESTRICT sums, int functions) {
  constexpr int kNodes = LaneTable<T>::kNodes;
  const std::size_t stride = table.padded_lanes;
  Coefficients(table, scales, batch, normal, scratch);
  alignas(64) T values[kCapacity * 64 / sizeof(T)];
  for (int f = 0; f < functions; ++f) {
    ForLanes<T>(stride, [&](auto d, std::size_t lane) {
      using V = hn::Vec<decltype(d)>;
      const int lanes = static_cast<int>(hn::Lanes(d));
      const V rest = batch.singular ? hn::LoadU(d, table.static_part(f) + lane) : hn::Zero(d);
      const std::size_t offset = f * kNodes * stride + lane;
      // two independent Horner chains at a time
      for (int q = 0; q < batch.size; q += 2) {
        const T* HWY_RESTRICT c0 = scratch.interval[q] + offset;
        const T* HWY_RESTRICT c1 = scratch.interval[q + 1] + offset;
        const V t0 = hn::Set(d, scratch.local[q]), t1 = hn::Set(d, scratch.local[q + 1]);
        V v0 = hn::LoadU(d, c0 + (kNodes - 1) * stride),
          v1 = hn::LoadU(d, c1 + (kNodes - 1) * stride);
#pragma GCC unroll 8
        for (int degree = kNodes - 2; degree >= 0; --degree) {
          v0 = hn::MulAdd(v0, t0, hn::LoadU(d, c0 + degree * stride));
          v1 = hn::MulAdd(v1, t1, hn::LoadU(d, c1 + degree * stride));
        }
        hn::Store(hn::Sub(v0, rest), d, values + q * lanes);
        hn::Store(hn::Sub(v1, rest), d, values + (q + 1) * lanes);
      }
      Accumulate(d, scratch, f, batch.size, values, sums + lane, stride);
    });
  }
}

template <class T>
void Add(const T* HWY_RESTRICT sums, const Vec3& n, int padded_lanes,
         const PanelTarget<T>& target) {
  const std::size_t stride = padded_lanes;
  constexpr int kPair[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  ForLanes<T>(stride, [&](auto d, std::size_t lane) {
    using V = hn::Vec<decltype(d)>;
    const V normal[3] = {hn::Set(d, static_cast<T>(n[0])), hn::Set(d, static_cast<T>(n[1])),
                         hn::Set(d, static_cast<T>(n[2]))};
    const auto sum = [&](int row) { return hn::LoadU(d, sums + row * stride + lane); };
    const auto add = [&](T* block, int entry, V value) {
      T* HWY_RESTRICT at = block + entry * stride + lane;
      hn::StoreU(hn::Add(hn::LoadU(d, at), value), d, at);
    };
    for (int a = 0; a < 3; ++a) {
      const V trace = sum(kSumA + a);
      for (int e = 0; e < 6; ++e) {
        const V b = sum(kSumB + 6 * a + e);
        add(target.g[a], e, e == 0 || e == 3 || e == 5 ? hn::Add(b, trace) : b);
      }
      V p[3], q[3];
      for (int i = 0; i < 3; ++i) {
        p[i] = sum(kSumP + 3 * a + i);
        q[i] = sum(kSumQ + 3 * a + i);
      }
      const V pn =
          hn::MulAdd(p[0], normal[0], hn::MulAdd(p[1], normal[1], hn::Mul(p[2], normal[2])));
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          V value = sum(kSumS + 6 * a + kPair[i][j]);
          value = hn::MulAdd(normal[i], p[j], value);
          value = hn::MulAdd(q[i], normal[j], value);
          add(target.h[a], 3 * i + j, i == j ? hn::Add(value, pn) : value);
        }
    }
    // d = F n^T - M_1 (h.n),  l = (Fr + M_0) N with N = [n]_x
    const V zero = hn::Zero(d);
    const V cross[3][3] = {{zero, hn::Neg(normal[2]), normal[1]},
                           {normal[2], zero, hn::Neg(normal[0])},
                           {hn::Neg(normal[1]), normal[0], zero}};
    const V m1 = sum(kSumM1), m0 = sum(kSumM0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        V value = hn::Mul(sum(kSumF + i), normal[j]);
        if (i == j) value = hn::Add(value, m1);
        add(target.d, 3 * i + j, value);
        V rotation = hn::Mul(m0, cross[i][j]);
        for (int k = 0; k < 3; ++k)
          rotation = hn::MulAdd(sum(kSumFr + kPair[i][k]), cross[k][j], rotation);
        add(target.l, 3 * i + j, rotation);
      }
    // m(B) = -Fr B n - tr(B) (C_0 - M_0 + tr Fr) n + M_0 B n, column by column of B
    const V trace = hn::Add(hn::Add(sum(kSumFr), sum(kSumFr + 3)), sum(kSumFr + 5));
    const V dilation = hn::Add(hn::Sub(sum(kSumC0), m0), trace);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = j; k < 3; ++k) {
          const auto part = [&](int a, int b) {  // (M_0 - Fr)_ia n_b
            const V f = hn::Neg(sum(kSumFr + kPair[i][a]));
            return hn::Mul(i == a ? hn::Add(f, m0) : f, normal[b]);
          };
          const V value = j == k ? hn::Sub(part(j, j), hn::Mul(dilation, normal[i]))
                                 : hn::Add(part(j, k), part(k, j));
          add(target.m, 6 * i + kPair[j][k], value);
        }
  });
}

void AccumulateDouble(const LaneTable<double>& table, const KernelScales& scales,
                      const PointBatch& batch, const Vec3& normal, PanelScratch<double>& scratch,
                      double* HWY_RESTRICT sums, int functions) {
  Accumulate(table, scales, batch, normal, scratch, sums, functions);
}
void AccumulateFloat(const LaneTable<float>& table, const KernelScales& scales,
                     const PointBatch& batch, const Vec3& normal, PanelScratch<float>& scratch,
                     float* HWY_RESTRICT sums, int functions) {
  Accumulate(table, scales, batch, normal, scratch, sums, functions);
}
void AddDouble(const double* HWY_RESTRICT sums, const Vec3& n, int padded_lanes,
               const PanelTarget<double>& target) {
  Add(sums, n, padded_lanes, target);
}
void AddFloat(const float* HWY_RESTRICT sums, const Vec3& n, int padded_lanes,
              const PanelTarget<float>& target) {
  Add(sums, n, padded_lanes, target);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(AccumulateDouble);
HWY_EXPORT(AccumulateFloat);
HWY_EXPORT(AddDouble);
HWY_EXPORT(AddFloat);

KernelScales::KernelScales(double shear_modulus, double shear_speed, double dt)
    : displacement(1 / (4 * kPi * shear_modulus)),
      traction(1 / (4 * kPi)),
      body_force(1 / (4 * kPi * shear_speed * shear_speed)),
      lam_per_distance(1 / (shear_speed * dt)) {}

void accumulate_panel(const LaneTable<double>& table, const KernelScales& scales,
                      const PointBatch& batch, const Vec3& normal, PanelScratch<double>& scratch,
                      double* sums, int functions) {
  HWY_DYNAMIC_DISPATCH(AccumulateDouble)(table, scales, batch, normal, scratch, sums, functions);
}

void accumulate_panel(const LaneTable<float>& table, const KernelScales& scales,
                      const PointBatch& batch, const Vec3& normal, PanelScratch<float>& scratch,
                      float* sums, int functions) {
  HWY_DYNAMIC_DISPATCH(AccumulateFloat)(table, scales, batch, normal, scratch, sums, functions);
}

void add_panel(const double* sums, const Vec3& normal, int padded_lanes,
               const PanelTarget<double>& target) {
  HWY_DYNAMIC_DISPATCH(AddDouble)(sums, normal, padded_lanes, target);
}

void add_panel(const float* sums, const Vec3& normal, int padded_lanes,
               const PanelTarget<float>& target) {
  HWY_DYNAMIC_DISPATCH(AddFloat)(sums, normal, padded_lanes, target);
}

}  // namespace bem
#endif  // HWY_ONCE
