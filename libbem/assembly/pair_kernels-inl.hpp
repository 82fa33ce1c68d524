// Kernels between points of two surfaces in vector lanes: the coefficients of their tensors, and
// the radial functions. Included after hwy/foreach_target.h, once per instruction set.
#if defined(BEM_PAIR_KERNELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef BEM_PAIR_KERNELS_INL
#undef BEM_PAIR_KERNELS_INL
#else
#define BEM_PAIR_KERNELS_INL
#endif

#include "assembly/lane_sums-inl.hpp"
#include "assembly/pair_batch.hpp"

#include <hwy/highway.h>

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
  int used_lanes = 0;
  for (int q = 0; q < padded_size; ++q) {
    const int interval = static_cast<int>(intervals[q]);
    scratch.interval[q] = table.interval(interval);
    used_lanes = std::max(used_lanes, table.used_lanes[interval]);
  }
  scratch.used_lanes = used_lanes;
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

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#endif
