// Compiled once per instruction set and dispatched at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compress/layered_product.cpp"
#include "compress/layered_product.hpp"

#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace bem {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Single = hn::CappedTag<float, 16>;
using V = hn::Vec<Single>;

HWY_INLINE V LoadAsFloat(Single d, const float* from) {
  return hn::LoadU(d, from);
}
HWY_INLINE V LoadAsFloat(Single d, const std::int16_t* from) {
  const hn::RebindToSigned<Single> di;
  return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::int16_t, Single>(), from)));
}
HWY_INLINE V LoadAsFloat(Single d, const std::int8_t* from) {
  const hn::RebindToSigned<Single> di;
  return hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::int8_t, Single>(), from)));
}

/// `vectors` vectors of rows, the last of which may go beyond the rows. Columns are summed in
/// `chains` independent sums, so that one addition need not wait for the last.
template <int vectors, int chains, class T>
HWY_INLINE void MultiplyTile(const T* HWY_RESTRICT a, std::size_t rows, std::size_t stride,
                             std::size_t columns, const float* HWY_RESTRICT x,
                             float* HWY_RESTRICT y) {
  const Single d;
  const std::size_t lanes = hn::Lanes(d);
  V sum[chains][vectors];
#pragma GCC unroll 8
  for (int c = 0; c < chains; ++c)
#pragma GCC unroll 8
    for (int v = 0; v < vectors; ++v) sum[c][v] = hn::Zero(d);
  std::size_t j = 0;
  for (; j + chains <= columns; j += chains)
#pragma GCC unroll 8
    for (int c = 0; c < chains; ++c) {
      const V factor = hn::Set(d, x[j + c]);
      const T* column = a + (j + c) * stride;
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v)
        sum[c][v] = hn::MulAdd(LoadAsFloat(d, column + v * lanes), factor, sum[c][v]);
    }
  for (; j < columns; ++j) {
    const V factor = hn::Set(d, x[j]);
#pragma GCC unroll 8
    for (int v = 0; v < vectors; ++v)
      sum[0][v] = hn::MulAdd(LoadAsFloat(d, a + j * stride + v * lanes), factor, sum[0][v]);
  }
#pragma GCC unroll 8
  for (int v = 0; v < vectors; ++v) {
    V total = sum[0][v];
#pragma GCC unroll 8
    for (int c = 1; c < chains; ++c) total = hn::Add(total, sum[c][v]);
    float* to = y + v * lanes;
    const std::size_t left = rows - v * lanes;
    if (left >= lanes) {
      hn::StoreU(hn::Add(hn::LoadU(d, to), total), d, to);
    } else {
      HWY_ALIGN float last[16];
      hn::Store(total, d, last);
      for (std::size_t i = 0; i < left; ++i) to[i] += last[i];
    }
  }
}

template <class T>
void MultiplyColumns(const T* a, std::size_t rows, std::size_t columns, const float* x, float* y) {
  const std::size_t lanes = hn::Lanes(Single());
  for (std::size_t i = 0; i < rows;) {
    const std::size_t vectors = std::min<std::size_t>((rows - i + lanes - 1) / lanes, 6);
    const std::size_t tile = std::min(rows - i, vectors * lanes);
    switch (vectors) {
      case 1:
        MultiplyTile<1, 8>(a + i, tile, rows, columns, x, y + i);
        break;
      case 2:
        MultiplyTile<2, 4>(a + i, tile, rows, columns, x, y + i);
        break;
      case 3:
        MultiplyTile<3, 4>(a + i, tile, rows, columns, x, y + i);
        break;
      case 4:
        MultiplyTile<4, 2>(a + i, tile, rows, columns, x, y + i);
        break;
      case 5:
        MultiplyTile<5, 2>(a + i, tile, rows, columns, x, y + i);
        break;
      default:
        MultiplyTile<6, 2>(a + i, tile, rows, columns, x, y + i);
    }
    i += tile;
  }
}

/// Columns times `vectors` vectors of rows, of which the last counts up to `rows` only.
template <int vectors, class T>
HWY_INLINE void MultiplyTileTransposed(const T* HWY_RESTRICT a, std::size_t rows,
                                       std::size_t stride, std::size_t columns,
                                       const float* HWY_RESTRICT x, float* HWY_RESTRICT y) {
  constexpr int kTogether = 4;  // columns, whose sums are independent
  const Single d;
  const std::size_t lanes = hn::Lanes(d), left = rows - (vectors - 1) * lanes;
  const auto counts = hn::FirstN(d, left);
  HWY_ALIGN float last[16] = {};
  std::copy_n(x + (vectors - 1) * lanes, left, last);
  V factor[vectors];
#pragma GCC unroll 8
  for (int v = 0; v < vectors; ++v)
    factor[v] = v + 1 < vectors ? hn::LoadU(d, x + v * lanes) : hn::Load(d, last);
  const auto column = [&](std::size_t j) {
    V sum = hn::Zero(d);
#pragma GCC unroll 8
    for (int v = 0; v < vectors; ++v) {
      V value = LoadAsFloat(d, a + j * stride + v * lanes);
      if (v + 1 == vectors) value = hn::IfThenElseZero(counts, value);  // whatever stands there
      sum = hn::MulAdd(value, factor[v], sum);
    }
    return sum;
  };
  std::size_t j = 0;
  for (; j + kTogether <= columns; j += kTogether) {
    V sum[kTogether];
#pragma GCC unroll 4
    for (int c = 0; c < kTogether; ++c) sum[c] = column(j + c);
#pragma GCC unroll 4
    for (int c = 0; c < kTogether; ++c) y[j + c] += hn::GetLane(hn::SumOfLanes(d, sum[c]));
  }
  for (; j < columns; ++j) y[j] += hn::GetLane(hn::SumOfLanes(d, column(j)));
}

template <class T>
void MultiplyColumnsTransposed(const T* a, std::size_t rows, std::size_t columns, const float* x,
                               float* y) {
  const std::size_t lanes = hn::Lanes(Single());
  for (std::size_t i = 0; i < rows;) {
    const std::size_t vectors = std::min<std::size_t>((rows - i + lanes - 1) / lanes, 4);
    const std::size_t tile = std::min(rows - i, vectors * lanes);
    switch (vectors) {
      case 1:
        MultiplyTileTransposed<1>(a + i, tile, rows, columns, x + i, y);
        break;
      case 2:
        MultiplyTileTransposed<2>(a + i, tile, rows, columns, x + i, y);
        break;
      case 3:
        MultiplyTileTransposed<3>(a + i, tile, rows, columns, x + i, y);
        break;
      default:
        MultiplyTileTransposed<4>(a + i, tile, rows, columns, x + i, y);
    }
    i += tile;
  }
}

void MultiplyInt8(const std::int8_t* a, std::size_t rows, std::size_t columns, const float* x,
                  float* y) {
  MultiplyColumns(a, rows, columns, x, y);
}
void MultiplyInt16(const std::int16_t* a, std::size_t rows, std::size_t columns, const float* x,
                   float* y) {
  MultiplyColumns(a, rows, columns, x, y);
}
void MultiplyFloat(const float* a, std::size_t rows, std::size_t columns, const float* x,
                   float* y) {
  MultiplyColumns(a, rows, columns, x, y);
}
void MultiplyTransposedInt8(const std::int8_t* a, std::size_t rows, std::size_t columns,
                            const float* x, float* y) {
  MultiplyColumnsTransposed(a, rows, columns, x, y);
}
void MultiplyTransposedInt16(const std::int16_t* a, std::size_t rows, std::size_t columns,
                             const float* x, float* y) {
  MultiplyColumnsTransposed(a, rows, columns, x, y);
}
void MultiplyTransposedFloat(const float* a, std::size_t rows, std::size_t columns, const float* x,
                             float* y) {
  MultiplyColumnsTransposed(a, rows, columns, x, y);
}

}  // namespace HWY_NAMESPACE
}  // namespace bem
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bem {

HWY_EXPORT(MultiplyInt8);
HWY_EXPORT(MultiplyInt16);
HWY_EXPORT(MultiplyFloat);
HWY_EXPORT(MultiplyTransposedInt8);
HWY_EXPORT(MultiplyTransposedInt16);
HWY_EXPORT(MultiplyTransposedFloat);

void multiply_columns(const std::int8_t* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyInt8)(a, rows, columns, x, y);
}

void multiply_columns(const std::int16_t* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyInt16)(a, rows, columns, x, y);
}

void multiply_columns(const float* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyFloat)(a, rows, columns, x, y);
}

void multiply_columns_transposed(const std::int8_t* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyTransposedInt8)(a, rows, columns, x, y);
}

void multiply_columns_transposed(const std::int16_t* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyTransposedInt16)(a, rows, columns, x, y);
}

void multiply_columns_transposed(const float* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y) {
  HWY_DYNAMIC_DISPATCH(MultiplyTransposedFloat)(a, rows, columns, x, y);
}

}  // namespace bem
#endif  // HWY_ONCE
