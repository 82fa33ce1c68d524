// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "assembly/lane_rows.cpp"
#include "assembly/lane_rows.hpp"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format off: after foreach_target.h
#include "assembly/lane_sums-inl.hpp"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// `count` vectors of a row of CombineAll().
template <int count, bool adds, class D, class T = hn::TFromD<D>>
HWY_INLINE void CombineRow(D d, const SparseRows& rows, int row, const T* from, std::size_t stride,
                           double part, T* to) {
  using V = hn::Vec<D>;
  V sum[count];
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) sum[i] = adds ? hn::LoadU(d, to + i * hn::Lanes(d)) : hn::Zero(d);
  for (int k = rows.begin[row]; k < rows.begin[row + 1]; ++k) {
    const V value = hn::Set(d, static_cast<T>(part * rows.values[k]));
    const T* HWY_RESTRICT source = from + rows.items[k] * stride;
#pragma GCC unroll 8
    for (int i = 0; i < count; ++i)
      sum[i] = hn::MulAdd(value, hn::LoadU(d, source + i * hn::Lanes(d)), sum[i]);
  }
#pragma GCC unroll 8
  for (int i = 0; i < count; ++i) hn::StoreU(sum[i], d, to + i * hn::Lanes(d));
}

template <bool adds, class T>
void CombineAll(const SparseRows& rows, const T* from, std::size_t stride, std::size_t size,
                double part, const int* rows_of_to, T* to) {
  const WholeVector<T> d;
  constexpr std::size_t kTogether = 8;
  const std::size_t most = kTogether * hn::Lanes(d);
  for (int row = 0; row < rows.rows(); ++row) {
    T* const out = to + static_cast<std::size_t>(adds ? rows_of_to[row] : row) * size;
    std::size_t at = 0;
    for (; at + most <= size; at += most)
      CombineRow<kTogether, adds>(d, rows, row, from + at, stride, part, out + at);
    ForLanes<T>(size - at, [&](auto tag, std::size_t rest) {
      CombineRow<1, adds>(tag, rows, row, from + at + rest, stride, part, out + at + rest);
    });
  }
}

/// `rows_of_to`: where rows are added; null: they are set, one after another.
template <class T>
void CombineRows(const SparseRows& rows, const T* from, std::size_t stride, std::size_t size,
                 double part, const int* rows_of_to, T* to) {
  const auto combine = rows_of_to ? CombineAll<true, T> : CombineAll<false, T>;
  combine(rows, from, stride, size, part, rows_of_to, to);
}

template <class T>
void AddStrain(const T* HWY_RESTRICT uniform, std::size_t lanes,
               const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
               T* HWY_RESTRICT out) {
  ForLanes<T>(lanes, [&](auto d, std::size_t lane) {
    using V = hn::Vec<decltype(d)>;
    const auto sum = [&](int entry) { return hn::LoadU(d, uniform + entry * lanes + lane); };
    for (int i = 0; i < 3; ++i) {
      const V j[3] = {sum(3 * i), sum(3 * i + 1), sum(3 * i + 2)}, p = sum(9 + i);
      for (int c = 0; c < 6; ++c) {
        T* HWY_RESTRICT to = out + (i * 6 + c) * lanes + lane;
        V total = hn::MulAdd(hn::Set(d, static_cast<T>(pressure[c])), p, hn::LoadU(d, to));
        for (int l = 0; l < 3; ++l)
          total = hn::MulAdd(hn::Set(d, static_cast<T>(tractions(l, c))), j[l], total);
        hn::StoreU(total, d, to);
      }
    }
  });
}

void CombineRowsDouble(const SparseRows& rows, const double* from, std::size_t stride,
                       std::size_t size, double part, const int* rows_of_to, double* to) {
  CombineRows(rows, from, stride, size, part, rows_of_to, to);
}
void CombineRowsFloat(const SparseRows& rows, const float* from, std::size_t stride,
                      std::size_t size, double part, const int* rows_of_to, float* to) {
  CombineRows(rows, from, stride, size, part, rows_of_to, to);
}
void AddStrainDouble(const double* uniform, std::size_t lanes,
                     const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                     double* out) {
  AddStrain(uniform, lanes, tractions, pressure, out);
}
void AddStrainFloat(const float* uniform, std::size_t lanes,
                    const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                    float* out) {
  AddStrain(uniform, lanes, tractions, pressure, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(CombineRowsDouble);
HWY_EXPORT(CombineRowsFloat);
HWY_EXPORT(AddStrainDouble);
HWY_EXPORT(AddStrainFloat);

void combine_rows(const SparseRows& rows, const double* from, std::size_t stride, std::size_t size,
                  double* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsDouble)(rows, from, stride, size, 1, nullptr, to);
}

void add_combined_rows(const SparseRows& rows, const double* from, std::size_t size, double part,
                       const std::vector<int>& rows_of_to, double* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsDouble)(rows, from, size, size, part, rows_of_to.data(), to);
}

void combine_rows(const SparseRows& rows, const float* from, std::size_t stride, std::size_t size,
                  float* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsFloat)(rows, from, stride, size, 1, nullptr, to);
}

void add_combined_rows(const SparseRows& rows, const float* from, std::size_t size, double part,
                       const std::vector<int>& rows_of_to, float* to) {
  HWY_DYNAMIC_DISPATCH(CombineRowsFloat)(rows, from, size, size, part, rows_of_to.data(), to);
}

void add_strain(const double* uniform, std::size_t lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure,
                double* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainDouble)(uniform, lanes, tractions, pressure, out);
}

void add_strain(const float* uniform, std::size_t lanes,
                const Eigen::Matrix<double, 3, 6>& tractions, const Vector6& pressure, float* out) {
  HWY_DYNAMIC_DISPATCH(AddStrainFloat)(uniform, lanes, tractions, pressure, out);
}

}  // namespace bem
#endif
