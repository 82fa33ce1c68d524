#pragma once

#include <cstddef>
#include <cstdint>

namespace bem {

/// y[i] += sum_j a[j*rows + i] x[j] for i in [0, rows), j in [0, columns): a column-major matrix of
/// small integers or single precision numbers, products and sums in single precision. May read up
/// to 64 bytes beyond the matrix. Pure, single threaded.
void multiply_columns(const std::int8_t* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y);
void multiply_columns(const std::int16_t* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y);
void multiply_columns(const float* a, std::size_t rows, std::size_t columns, const float* x,
                      float* y);

/// y[j] += sum_i a[j*rows + i] x[i] for the same matrices.
void multiply_columns_transposed(const std::int8_t* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y);
void multiply_columns_transposed(const std::int16_t* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y);
void multiply_columns_transposed(const float* a, std::size_t rows, std::size_t columns,
                                 const float* x, float* y);

}  // namespace bem
