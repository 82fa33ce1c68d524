// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compress/matrix_product.cpp"
#include "compress/matrix_product.hpp"

#include "base/error.hpp"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<double, 8>;

HWY_INLINE hn::Vec<Wide> LoadMatrix(Wide d, const double* from) {
  return hn::LoadU(d, from);
}
HWY_INLINE hn::Vec<Wide> LoadMatrix(Wide d, const float* from) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, Wide>(), from));
}

/// `rows` rows times `count` right-hand sides, all sums in registers.
template <int rows, int count, class T>
HWY_INLINE void MultiplyBlock(const T* HWY_RESTRICT a, std::size_t columns, std::size_t row_stride,
                              const double* HWY_RESTRICT x, std::size_t x_stride,
                              double* HWY_RESTRICT y, std::size_t y_stride) {
  const Wide d;
  using V = hn::Vec<Wide>;
  const std::size_t lanes = hn::Lanes(d);
  V sum[rows][count];
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < count; ++c) sum[r][c] = hn::Zero(d);
  std::size_t j = 0;
  for (; j + lanes <= columns; j += lanes) {
    V value[count];
#pragma GCC unroll 4
    for (int c = 0; c < count; ++c) value[c] = hn::LoadU(d, x + c * x_stride + j);
#pragma GCC unroll 4
    for (int r = 0; r < rows; ++r) {
      const V m = LoadMatrix(d, a + r * row_stride + j);
#pragma GCC unroll 4
      for (int c = 0; c < count; ++c) sum[r][c] = hn::MulAdd(m, value[c], sum[r][c]);
    }
  }
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < count; ++c) {
      double total = hn::GetLane(hn::SumOfLanes(d, sum[r][c]));
      for (std::size_t k = j; k < columns; ++k)
        total += a[r * row_stride + k] * x[c * x_stride + k];
      y[c * y_stride + r] += total;
    }
}

template <int count, class T>
void MultiplyAll(const T* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                 const double* x, std::size_t x_stride, double* y, std::size_t y_stride) {
  constexpr int kRows = 4;  // streams of the matrix that are read side by side
  std::size_t i = 0;
  for (; i + kRows <= rows; i += kRows)
    MultiplyBlock<kRows, count>(a + i * row_stride, columns, row_stride, x, x_stride, y + i,
                                y_stride);
  for (; i < rows; ++i)
    MultiplyBlock<1, count>(a + i * row_stride, columns, row_stride, x, x_stride, y + i, y_stride);
}

template <class T>
void Multiply(const T* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
              const double* x, std::size_t x_stride, double* y, std::size_t y_stride, int count) {
  switch (count) {
    case 1:
      return MultiplyAll<1>(a, rows, columns, row_stride, x, x_stride, y, y_stride);
    case 2:
      return MultiplyAll<2>(a, rows, columns, row_stride, x, x_stride, y, y_stride);
    case 3:
      return MultiplyAll<3>(a, rows, columns, row_stride, x, x_stride, y, y_stride);
    default:
      return MultiplyAll<4>(a, rows, columns, row_stride, x, x_stride, y, y_stride);
  }
}

void MultiplyFloat(const float* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                   const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                   int count) {
  Multiply(a, rows, columns, row_stride, x, x_stride, y, y_stride, count);
}
void MultiplyDouble(const double* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                    const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                    int count) {
  Multiply(a, rows, columns, row_stride, x, x_stride, y, y_stride, count);
}

/// Four columns at a time, so that four streams are read side by side and y is touched less often.
template <class T>
void AddColumns(const T* const* columns, std::size_t count, std::size_t first, std::size_t rows,
                const double* x, double* HWY_RESTRICT y) {
  const Wide d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t c = 0; c < count; c += 4) {
    const T* a[4];
    double factor[4];
    for (std::size_t k = 0; k < 4; ++k) {
      a[k] = columns[std::min(c + k, count - 1)] + first;
      factor[k] = c + k < count ? x[c + k] : 0;
    }
    const auto f0 = hn::Set(d, factor[0]), f1 = hn::Set(d, factor[1]);
    const auto f2 = hn::Set(d, factor[2]), f3 = hn::Set(d, factor[3]);
    std::size_t i = 0;
    for (; i + lanes <= rows; i += lanes) {
      auto sum = hn::MulAdd(LoadMatrix(d, a[0] + i), f0, hn::LoadU(d, y + i));
      sum = hn::MulAdd(LoadMatrix(d, a[1] + i), f1, sum);
      sum = hn::MulAdd(LoadMatrix(d, a[2] + i), f2, sum);
      sum = hn::MulAdd(LoadMatrix(d, a[3] + i), f3, sum);
      hn::StoreU(sum, d, y + i);
    }
    for (; i < rows; ++i)
      for (int k = 0; k < 4; ++k) y[i] += a[k][i] * factor[k];
  }
}

void AddColumnsFloat(const float* const* columns, std::size_t count, std::size_t first,
                     std::size_t rows, const double* x, double* y) {
  AddColumns(columns, count, first, rows, x, y);
}
void AddColumnsDouble(const double* const* columns, std::size_t count, std::size_t first,
                      std::size_t rows, const double* x, double* y) {
  AddColumns(columns, count, first, rows, x, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(MultiplyFloat);
HWY_EXPORT(MultiplyDouble);
HWY_EXPORT(AddColumnsFloat);
HWY_EXPORT(AddColumnsDouble);

void multiply_rows(const float* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                   const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                   int count) {
  require(count >= 1 && count <= kMaxRightHandSides, "1 to 4 right-hand sides");
  HWY_DYNAMIC_DISPATCH(MultiplyFloat)
  (a, rows, columns, row_stride, x, x_stride, y, y_stride, count);
}

void multiply_rows(const double* a, std::size_t rows, std::size_t columns, std::size_t row_stride,
                   const double* x, std::size_t x_stride, double* y, std::size_t y_stride,
                   int count) {
  require(count >= 1 && count <= kMaxRightHandSides, "1 to 4 right-hand sides");
  HWY_DYNAMIC_DISPATCH(MultiplyDouble)
  (a, rows, columns, row_stride, x, x_stride, y, y_stride, count);
}

void add_columns(const float* const* columns, std::size_t count, std::size_t first,
                 std::size_t rows, const double* x, double* y) {
  HWY_DYNAMIC_DISPATCH(AddColumnsFloat)(columns, count, first, rows, x, y);
}

void add_columns(const double* const* columns, std::size_t count, std::size_t first,
                 std::size_t rows, const double* x, double* y) {
  HWY_DYNAMIC_DISPATCH(AddColumnsDouble)(columns, count, first, rows, x, y);
}

}  // namespace bem
#endif  // HWY_ONCE
