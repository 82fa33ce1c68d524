#pragma once

#include "base/types.hpp"

#include <array>
#include <cstdint>

namespace bem {

/// Shape of a layered matrix: entries in units of a quantum, as integers where these are small.
/// Entries are single precision in the first rows[0] x columns[0], 16-bit integers in what the
/// first rows[1] x columns[1] have besides, 8-bit ones in what the first rows[2] x columns[2] have
/// besides, and zero elsewhere; the extents ascend. Data: the rectangles one after another, wide
/// ones first, each column by column, padded to a multiple of 4 bytes.
struct Layers {
  std::array<std::uint16_t, 3> rows = {0, 0, 0}, columns = {0, 0, 0};

  int stored_rows() const { return rows[2]; }
  int stored_columns() const { return columns[2]; }
  std::size_t bytes() const;
  bool operator==(const Layers& o) const { return rows == o.rows && columns == o.columns; }
};

/// A matrix that has the extents of its layers.
using FloatMatrix = Eigen::MatrixXf;

/// The smallest layers for entries in units of the quantum. They are small where entries become
/// small towards the last rows and columns. Extents of up to 65535.
Layers fit_layers(const FloatMatrix& entries);

/// Rounds the entries to what the layers hold, appends their bytes to `data`, and subtracts what
/// was stored from `entries`, which leaves the errors.
void store_layers(const Layers& layers, FloatMatrix& entries, std::vector<std::uint8_t>& data);

/// The entries, stored_rows() x stored_columns(), in units of the quantum.
FloatMatrix load_layers(const Layers& layers, const std::uint8_t* data);

/// One stored column, stored_rows() numbers.
void load_layers_column(const Layers& layers, const std::uint8_t* data, int column, float* out);

/// One stored row, stored_columns() numbers.
void load_layers_row(const Layers& layers, const std::uint8_t* data, int row, float* out);

/// y[i] += sum_j a(i, j) x[j] for the stored rows and columns, in single precision. Every byte is
/// read once. Pure, on the widest vector unit of the machine. `data` is aligned to 4 bytes and
/// followed by 64 bytes that may be read.
void multiply_layers(const Layers& layers, const std::uint8_t* data, const float* x, float* y);

/// y[j] += sum_i a(i, j) x[i], in the same way.
void multiply_layers_transposed(const Layers& layers, const std::uint8_t* data, const float* x,
                                float* y);

}  // namespace bem
