#include "compress/layered_matrix.hpp"

#include "base/error.hpp"
#include "compress/layered_product.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace bem {
namespace {

std::uint16_t extent(Eigen::Index n) {
  require(n <= std::numeric_limits<std::uint16_t>::max(),
          "a layered matrix has at most 65535 rows");
  return static_cast<std::uint16_t>(n);
}

/// One rectangle of a layer.
struct Rectangle {
  int layer, row, column, rows, columns;
  std::size_t offset;  ///< of its bytes

  std::size_t entries() const { return static_cast<std::size_t>(rows) * columns; }
};

constexpr std::size_t kWidths[3] = {4, 2, 1};

/// The nearest integer of a number whose size is below 2^22.
float rounded(float x) {
  constexpr float kShift = 12582912;  // 1.5 * 2^23: its last bit is worth one
  return (x + kShift) - kShift;
}

/// Calls f for every rectangle that is not empty, in the order of the data; returns its bytes.
template <class F>
std::size_t for_each_rectangle(const Layers& layers, const F& f) {
  std::size_t offset = 0;
  int rows = 0, columns = 0;
  for (int layer = 0; layer < 3; ++layer) {
    const int r = layers.rows[layer], c = layers.columns[layer];
    // below and to the right of what wider layers hold
    const Rectangle parts[2] = {{layer, rows, 0, r - rows, columns, 0},
                                {layer, 0, columns, r, c - columns, 0}};
    for (Rectangle part : parts) {
      if (part.rows == 0 || part.columns == 0) continue;
      part.offset = offset;
      f(part);
      offset += part.entries() * kWidths[layer];
    }
    rows = r;
    columns = c;
  }
  return (offset + 3) / 4 * 4;
}

template <class T>
void store(const Rectangle& part, FloatMatrix& entries, std::uint8_t* out) {
  T* to = reinterpret_cast<T*>(out);
  for (int j = part.column; j < part.column + part.columns; ++j)
    for (int i = part.row; i < part.row + part.rows; ++i) {
      const float value = entries(i, j);
      *to = static_cast<T>(std::is_integral_v<T> ? rounded(value) : value);
      entries(i, j) -= static_cast<float>(*to++);
    }
}

template <class T>
void load(const Rectangle& part, const std::uint8_t* data, FloatMatrix& out) {
  const T* from = reinterpret_cast<const T*>(data + part.offset);
  for (int j = part.column; j < part.column + part.columns; ++j)
    for (int i = part.row; i < part.row + part.rows; ++i) out(i, j) = static_cast<float>(*from++);
}

template <class T>
void load_column(const Rectangle& part, const std::uint8_t* data, int column, float* out) {
  const T* from = reinterpret_cast<const T*>(data + part.offset) +
                  static_cast<std::size_t>(column - part.column) * part.rows;
  for (int i = 0; i < part.rows; ++i) out[part.row + i] = static_cast<float>(from[i]);
}

template <class T>
void load_row(const Rectangle& part, const std::uint8_t* data, int row, float* out) {
  const T* from = reinterpret_cast<const T*>(data + part.offset) + (row - part.row);
  for (int j = 0; j < part.columns; ++j)
    out[part.column + j] = static_cast<float>(from[static_cast<std::size_t>(j) * part.rows]);
}

template <class T>
void multiply(const Rectangle& part, const std::uint8_t* data, const float* x, float* y) {
  multiply_columns(reinterpret_cast<const T*>(data + part.offset),
                   static_cast<std::size_t>(part.rows), static_cast<std::size_t>(part.columns),
                   x + part.column, y + part.row);
}

template <class T>
void multiply_transposed(const Rectangle& part, const std::uint8_t* data, const float* x,
                         float* y) {
  multiply_columns_transposed(
      reinterpret_cast<const T*>(data + part.offset), static_cast<std::size_t>(part.rows),
      static_cast<std::size_t>(part.columns), x + part.row, y + part.column);
}

/// Calls the instance of a function template for the type of a layer.
#define BEM_FOR_LAYER(layer, function, ...) \
  switch (layer) {                          \
    case 0:                                 \
      function<float>(__VA_ARGS__);         \
      break;                                \
    case 1:                                 \
      function<std::int16_t>(__VA_ARGS__);  \
      break;                                \
    default:                                \
      function<std::int8_t>(__VA_ARGS__);   \
  }

}  // namespace

std::size_t Layers::bytes() const {
  return for_each_rectangle(*this, [](const Rectangle&) {});
}

Layers fit_layers(const FloatMatrix& entries) {
  constexpr float kMost[3] = {32767.5F, 127.5F, 0.5F};  // round to what narrower layers hold
  Layers layers;
  for (int layer = 0; layer < 3; ++layer) {
    Eigen::Index rows = 0, columns = 0;
    for (Eigen::Index j = 0; j < entries.cols(); ++j) {
      Eigen::Index last = entries.rows();
      // a column that adds no rows is of interest only if it has anything at all
      while (last > rows && std::abs(entries(last - 1, j)) < kMost[layer]) --last;
      if (last == rows && (entries.col(j).head(rows).array().abs() < kMost[layer]).all()) continue;
      rows = last;
      columns = j + 1;
    }
    layers.rows[layer] = extent(rows);
    layers.columns[layer] = extent(columns);
  }
  return layers;
}

void store_layers(const Layers& layers, FloatMatrix& entries, std::vector<std::uint8_t>& data) {
  const std::size_t begin = data.size();
  data.resize(begin + layers.bytes());
  for_each_rectangle(layers, [&](const Rectangle& part) {
    BEM_FOR_LAYER(part.layer, store, part, entries, data.data() + begin + part.offset)
  });
}

FloatMatrix load_layers(const Layers& layers, const std::uint8_t* data) {
  FloatMatrix out = FloatMatrix::Zero(layers.stored_rows(), layers.stored_columns());
  for_each_rectangle(
      layers, [&](const Rectangle& part) { BEM_FOR_LAYER(part.layer, load, part, data, out) });
  return out;
}

void load_layers_column(const Layers& layers, const std::uint8_t* data, int column, float* out) {
  std::fill_n(out, layers.stored_rows(), 0.0F);
  for_each_rectangle(layers, [&](const Rectangle& part) {
    if (column < part.column || column >= part.column + part.columns) return;
    BEM_FOR_LAYER(part.layer, load_column, part, data, column, out)
  });
}

void load_layers_row(const Layers& layers, const std::uint8_t* data, int row, float* out) {
  std::fill_n(out, layers.stored_columns(), 0.0F);
  for_each_rectangle(layers, [&](const Rectangle& part) {
    if (row < part.row || row >= part.row + part.rows) return;
    BEM_FOR_LAYER(part.layer, load_row, part, data, row, out)
  });
}

void multiply_layers(const Layers& layers, const std::uint8_t* data, const float* x, float* y) {
  for_each_rectangle(
      layers, [&](const Rectangle& part) { BEM_FOR_LAYER(part.layer, multiply, part, data, x, y) });
}

void multiply_layers_transposed(const Layers& layers, const std::uint8_t* data, const float* x,
                                float* y) {
  for_each_rectangle(layers, [&](const Rectangle& part) {
    BEM_FOR_LAYER(part.layer, multiply_transposed, part, data, x, y)
  });
}

}  // namespace bem
